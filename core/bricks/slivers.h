#pragma once
#include "core/bricks/brick_grid.h"

namespace sprung {

/// Gives the solid of nearly empty bricks (fill below `least_fill`) to the fullest brick that shares a face with them,
/// if that is at least half full, and removes them: under a touch such a brick is a layer far softer than the sliver of
/// solid it stands for, and it would be crushed. The volume stays; a receiving brick's fill may pass 1. A sliver that
/// its neighbours need to hang on to the body stays too, so thin parts are neither lost nor cut off.
/// Returns how many bricks are gone.
int absorb_slivers(BrickGrid& grid, double least_fill = 0.1);

}  // namespace sprung
