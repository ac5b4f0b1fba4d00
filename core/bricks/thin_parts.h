#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/mesh/thickness.h"

namespace sprung {

/// Bricks that hang together and hold solid that is thinner than a brick.
struct ThinPart {
  std::vector<int> bricks;    // rows of the grid
  double thickness = 0;       // m, where it is thinnest: the median around a brick
  Vec3 place = Vec3::Zero();  // a point of the surface there
};

/// The parts of a body that are thinner than its bricks, thinnest first. A brick counts where most of the surface in it
/// and its neighbours is nearer to its far wall than the side of a brick, so the edge of a thick part does not; groups
/// of less than four bricks are left out in bodies that have more. `samples` in the grid's frame.
[[nodiscard]] std::vector<ThinPart> find_thin_parts(const BrickGrid& grid, const std::vector<WallSample>& samples);

}  // namespace sprung
