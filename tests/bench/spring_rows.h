#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace sprung::test {

/// A full box of bricks of size 1 whose edges and inner diagonals are springs of stiffness 1 between nodes of mass 1:
/// the rows of springs along x that SpringSystem is made of, without the overhead of materials, bodies of any shape and
/// threads. Its speed is what this machine can achieve with springs.
struct SpringRows {
  std::array<int, 3> nodes;  // along x, y and z; along x a multiple of 8
  std::array<std::vector<double>, 3> positions;
  std::array<std::vector<double>, 3> velocities;
  std::array<std::vector<double>, 3> forces;
  std::vector<double> shares;  // of the bricks of a row: 1, and 0 behind the last

  /// At rest but for a little noise.
  explicit SpringRows(const std::array<int, 3>& counts);

  [[nodiscard]] std::size_t brick_count() const;
};

}  // namespace sprung::test
