#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"

namespace sprung {

/// Bricks that share no cell, and whose nodes share no place of the lattice, by their rows in the grid, ascending: most
/// grids are one such layer; where parts of a body pass through the same cells, they fall into several. Every brick is
/// in one. Cost: linear in the bricks.
[[nodiscard]] std::vector<std::vector<int>> layers_of(const BrickGrid& grid);

}  // namespace sprung
