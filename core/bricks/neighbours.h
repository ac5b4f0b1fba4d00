#pragma once
#include <array>

#include "core/bricks/cell_index.h"

namespace sprung {

/// The bricks that share a face with a brick, by side: 2 axis, + 1 on the high side; -1: none there. Of several the
/// first. `index` is the grid's.
[[nodiscard]] std::array<int, 6> face_neighbours(const BrickGrid& grid, const CellIndex& index, std::size_t brick);

}  // namespace sprung
