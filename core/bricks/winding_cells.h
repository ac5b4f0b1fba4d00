#pragma once
#include "core/bricks/column_caster.h"

namespace sprung {

/// Sets `sums` to the share of each cell where the triangles' generalised winding number is beyond 1/2, whichever way
/// they are turned: for surfaces with gaps, where rays leak. Cells that a triangle may touch are sampled at 64 points,
/// others at their middle, or 64 together where none of them is near a triangle or a gap. Works in parallel;
/// deterministic. Cost: some 60 microseconds a cell at the surface.
void fill_by_winding(const CellSurface& surface, CellSums& sums);

}  // namespace sprung
