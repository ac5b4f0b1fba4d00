#pragma once
#include <array>
#include <vector>

#include "core/bricks/brick_grid.h"

namespace sprung {

/// How stiff the springs in the bricks' faces are, in full bricks: the bricks on both sides of a face add up, and the
/// face counts for one of them. Face a is the one across axis a; bricks are on two sides of it where they have all four
/// of its nodes in common.
struct FaceShares {
  std::array<std::vector<double>, 3> low;   // of each brick's face on the low side
  std::array<std::vector<double>, 3> high;  // on the high side; 0 where it counts for the brick behind it
};

/// `shares` per brick: of how many full bricks it has the stiffness. Cost: linear in the bricks but for a search in a
/// row of them.
[[nodiscard]] FaceShares share_faces(const BrickGrid& grid, const std::vector<double>& shares);

}  // namespace sprung
