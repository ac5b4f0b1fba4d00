#pragma once
#include <array>
#include <vector>

#include "core/bricks/brick_grid.h"

namespace sprung {

/// One of the six sides of a brick.
struct BrickFace {
  std::array<int, 4> nodes;  // counter-clockwise from outside
  int side;                  // 2 axis + (1 on the high side)
  int brick;
};

/// All sides of the bricks that are `shown` (one entry a brick), brick by brick.
[[nodiscard]] std::vector<BrickFace> brick_faces(const BrickGrid& grid, const std::vector<bool>& shown);

/// Those that no two of the shown bricks share.
[[nodiscard]] std::vector<BrickFace> outer_faces(const BrickGrid& grid, const std::vector<bool>& shown);
[[nodiscard]] std::vector<BrickFace> outer_faces(const BrickGrid& grid);

}  // namespace sprung
