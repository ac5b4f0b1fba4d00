#pragma once
#include <cstdint>
#include <unordered_map>

#include "core/bricks/brick_grid.h"

namespace sprung {

/// Finds the bricks at a cell of the lattice.
class CellIndex {
 public:
  explicit CellIndex(const BrickGrid& grid) : CellIndex(grid.cells) {}
  /// The same for any rows of cells.
  explicit CellIndex(const std::vector<Eigen::Vector3i>& cells) {
    row_of_cell_.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) row_of_cell_.emplace(key(cells[i]), static_cast<int>(i));
  }

  /// The first one where the cell comes several times; the others follow it. -1: there is none.
  [[nodiscard]] int at(const Eigen::Vector3i& cell) const {
    const auto found = row_of_cell_.find(key(cell));
    return found == row_of_cell_.end() ? -1 : found->second;
  }

 private:
  /// 21 bits an axis, for cells from -2^20 to 2^20.
  static std::uint64_t key(const Eigen::Vector3i& cell) {
    const auto part = [&](int axis) { return static_cast<std::uint64_t>(cell[axis] + (1 << 20)) & 0x1fffffU; };
    return part(0) | part(1) << 21 | part(2) << 42;
  }

  std::unordered_map<std::uint64_t, int> row_of_cell_;
};

}  // namespace sprung
