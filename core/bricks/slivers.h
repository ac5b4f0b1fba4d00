#pragma once
#include "core/bricks/brick_grid.h"

namespace sprung {

/// Adds the solid of nearly empty bricks (fill below `min_fill`) to the fullest of their face neighbours, if that is
/// at least half full, and removes them: in contact, such a brick is far softer than the sliver of solid it represents,
/// and would be crushed. The volume is preserved; the fill of a receiving brick may exceed 1. A sliver that connects
/// its neighbours to the body stays, so that thin parts are neither lost nor cut off. Bricks below a fill of 0.002 are
/// merged into the fullest brick that they touch if they connect nothing, and so are parts of less than a hundredth of
/// the body that are attached by a hinge: a node, an edge, or several on a line. Returns the number of removed bricks.
int absorb_slivers(BrickGrid& grid, double min_fill = 0.1);

/// Adds each brick with less than `min_share` of what the fullest one at its nodes holds to the fullest of its face
/// neighbours, if these are connected without it, and removes it: for laws that know where their solid lies
/// (BrickGrid::moments), where such a brick would add nodes with next to no stiffness. Returns the number of removed
/// bricks.
int absorb_loose_bricks(BrickGrid& grid, double min_share = 0.1);

}  // namespace sprung
