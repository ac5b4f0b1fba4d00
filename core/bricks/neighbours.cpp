#include "core/bricks/neighbours.h"

#include "core/bricks/corner.h"

namespace sprung {
namespace {

/// Whether brick `other` shares the face of `brick` on that side.
bool shares_face(const BrickGrid& grid, std::size_t brick, std::size_t other, int side) {
  const int axis = side / 2;
  const bool high = side % 2 != 0;
  for (int corner = 0; corner < 8; ++corner) {
    if (on_high_side(corner, axis) != high) continue;
    const auto across = static_cast<std::size_t>(corner ^ (1 << axis));
    if (grid.nodes[brick][static_cast<std::size_t>(corner)] != grid.nodes[other][across]) return false;
  }
  return true;
}

}  // namespace

std::array<int, 6> face_neighbours(const BrickGrid& grid, const CellIndex& index, std::size_t brick) {
  std::array<int, 6> neighbours{};
  for (int side = 0; side < 6; ++side) {
    Eigen::Vector3i cell = grid.cells[brick];
    cell[side / 2] += side % 2 == 0 ? -1 : 1;
    int other = index.at(cell);
    while (other >= 0 && !shares_face(grid, brick, static_cast<std::size_t>(other), side)) {
      ++other;
      if (other == grid.brick_count() || grid.cells[static_cast<std::size_t>(other)] != cell) other = -1;
    }
    neighbours[static_cast<std::size_t>(side)] = other;
  }
  return neighbours;
}

}  // namespace sprung
