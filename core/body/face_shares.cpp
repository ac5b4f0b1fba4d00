#include "core/body/face_shares.h"

#include <algorithm>

#include "core/bricks/corner.h"

namespace sprung {
namespace {

bool comes_before(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return std::array{a.z(), a.y(), a.x()} < std::array{b.z(), b.y(), b.x()};
}

/// Whether the high side of one brick is the low side of the other.
bool are_joined(const BrickGrid& grid, std::size_t brick, std::size_t next, int axis) {
  for (int corner = 0; corner < 8; ++corner) {
    if (on_high_side(corner, axis)) continue;
    const auto low = static_cast<std::size_t>(corner);
    if (grid.nodes[next][low] != grid.nodes[brick][low | 1U << static_cast<unsigned>(axis)]) return false;
  }
  return true;
}

/// The first brick behind this one, or the number of bricks. `from` is where the search begins: not behind the result.
std::size_t brick_behind(const BrickGrid& grid, std::size_t brick, int axis, std::size_t& from) {
  const Eigen::Vector3i cell = grid.cells[brick] + Eigen::Vector3i::Unit(axis);
  while (from < grid.cells.size() && comes_before(grid.cells[from], cell)) ++from;
  for (std::size_t next = from; next < grid.cells.size() && grid.cells[next] == cell; ++next) {
    if (are_joined(grid, brick, next, axis)) return next;
  }
  return grid.cells.size();
}

}  // namespace

FaceShares share_faces(const BrickGrid& grid, const std::vector<double>& shares) {
  FaceShares faces;
  faces.low.fill(shares);
  faces.high.fill(std::vector<double>(shares.size(), 0));
  // Cells ascend, and so do those behind them. All axes at once: a large body's bricks come from memory only once.
  std::array<std::size_t, 3> from{};
  for (std::size_t brick = 0; brick < shares.size(); ++brick) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = brick_behind(grid, brick, static_cast<int>(axis), from[axis]);
      (next < shares.size() ? faces.low[axis][next] : faces.high[axis][brick]) += shares[brick];
    }
  }
  return faces;
}

}  // namespace sprung
