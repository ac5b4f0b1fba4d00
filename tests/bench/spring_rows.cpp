#include "tests/bench/spring_rows.h"

#include <random>

namespace sprung::test {
namespace {

constexpr std::size_t kPadding = 8;  // behind the last node, for its neighbours
constexpr double kNoise = 1e-3;      // bricks
constexpr unsigned kSeed = 1;

}  // namespace

SpringRows::SpringRows(const std::array<int, 3>& counts) : nodes(counts) {
  const auto [columns, rows, layers] = counts;
  const auto stride = static_cast<std::size_t>(columns);
  const std::size_t count = stride * static_cast<std::size_t>(rows) * static_cast<std::size_t>(layers + 1);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> noise(-kNoise, kNoise);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    positions[axis].resize(count + stride + kPadding);
    velocities[axis].resize(count + stride + kPadding);
    forces[axis].resize(count + stride + kPadding);
  }
  for (std::size_t node = 0; node < positions[0].size(); ++node) {
    const std::size_t row = node / stride;
    positions[0][node] = static_cast<double>(node % stride) + noise(random);
    positions[1][node] = static_cast<double>(row % static_cast<std::size_t>(rows)) + noise(random);
    positions[2][node] = static_cast<double>(row / static_cast<std::size_t>(rows)) + noise(random);
  }
  shares.assign(stride, 1);
  shares.back() = 0;
}

std::size_t SpringRows::brick_count() const {
  return static_cast<std::size_t>(nodes[0] - 1) * static_cast<std::size_t>(nodes[1] - 1) *
         static_cast<std::size_t>(nodes[2] - 1);
}

}  // namespace sprung::test
