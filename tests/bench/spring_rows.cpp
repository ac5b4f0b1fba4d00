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
  const auto stride = std::size_t(columns);
  const std::size_t count = stride * std::size_t(rows) * std::size_t(layers + 1);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> noise(-kNoise, kNoise);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    positions[axis].resize(count + stride + kPadding);
    velocities[axis].resize(count + stride + kPadding);
    forces[axis].resize(count + stride + kPadding);
  }
  for (std::size_t node = 0; node < positions[0].size(); ++node) {
    const std::size_t row = node / stride;
    positions[0][node] = double(node % stride) + noise(random);
    positions[1][node] = double(row % std::size_t(rows)) + noise(random);
    positions[2][node] = double(row / std::size_t(rows)) + noise(random);
  }
  shares.assign(stride, 1);
  shares.back() = 0;
}

std::size_t SpringRows::brick_count() const {
  return std::size_t(nodes[0] - 1) * std::size_t(nodes[1] - 1) * std::size_t(nodes[2] - 1);
}

}  // namespace sprung::test
