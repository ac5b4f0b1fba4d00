// Compiled once for each instruction set; SPRUNG_BLOCK_FORCES is the name of the one function it gives.
#include "core/body/brick_block.h"

#include <algorithm>
#include <experimental/simd>

#include "core/body/brick_kernel.h"

namespace sprung {
namespace {

/// Eight doubles. A type of this file alone, so that no template made for it can be taken for another instruction
/// set's.
struct Pack {
  using Doubles = std::experimental::fixed_size_simd<double, kBricksPerBlock>;
  Doubles lanes;

  Pack() = default;
  Pack(double value) : lanes(value) {}
  Pack(const Doubles& values) : lanes(values) {}

  friend Pack operator+(const Pack& a, const Pack& b) { return a.lanes + b.lanes; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.lanes - b.lanes; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.lanes * b.lanes; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.lanes / b.lanes; }
  friend Pack& operator+=(Pack& a, const Pack& b) { return a = a + b; }
  friend Pack& operator-=(Pack& a, const Pack& b) { return a = a - b; }
  friend Pack sqrt(const Pack& a) { return std::experimental::sqrt(a.lanes); }
  friend Pack max(const Pack& a, const Pack& b) { return std::experimental::max(a.lanes, b.lanes); }
};

/// The bricks first .. first + 7 side by side; the last brick is repeated where there are fewer.
CornerVectors<Pack> gather(const BlockInput& input, const double* values, int first, double factor) {
  CornerVectors<Pack> packed;
  for (int lane = 0; lane < kBricksPerBlock; ++lane) {
    const std::array<int, 8>& nodes = input.nodes[std::min(first + lane, input.brick_count - 1)];
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const double* value = values + 3 * static_cast<std::ptrdiff_t>(nodes[corner]);
      for (std::size_t k = 0; k < 3; ++k) {
        packed[3 * corner + k].lanes[static_cast<std::size_t>(lane)] = factor * value[k];
      }
    }
  }
  return packed;
}

}  // namespace

void SPRUNG_BLOCK_FORCES(const BlockInput& input, int first, double* corner_forces, double* energies) {
  const CornerVectors<Pack> x = gather(input, input.positions, first, 1);
  CornerVectors<Pack> force;
  force.fill(Pack(0.0));
  Pack energy;
  if (input.beta > 0) {
    const CornerVectors<Pack> rates = gather(input, input.velocities, first, input.beta);
    energy = brick_forces<Pack>(*input.law, input.brick_size, x, &rates, force);
  } else {
    energy = brick_forces<Pack>(*input.law, input.brick_size, x, nullptr, force);
  }
  const int lanes = std::min(kBricksPerBlock, input.brick_count - first);
  for (int lane = 0; lane < lanes; ++lane) {
    const auto l = static_cast<std::size_t>(lane);
    const std::ptrdiff_t brick = first + lane;
    const double scale = input.stiffness_scale[brick];
    for (std::size_t i = 0; i < 24; ++i) corner_forces[24 * brick + static_cast<int>(i)] = scale * force[i].lanes[l];
    energies[brick] = scale * energy.lanes[l];
  }
}

}  // namespace sprung
