#pragma once
#include "core/bricks/column_caster.h"

namespace sprung {

/// Sets `sums` to the share of each cell that lies within half of `thickness` (in cells, > 0) from the triangles, at 64
/// points a cell. A shell thinner than a cell is sampled as if it were one cell thick, and the shares are reduced to
/// its thickness: so its cells still hang together by faces, and hold its mass. Deterministic.
void fill_shell(const CellSurface& surface, double thickness, CellSums& sums);

}  // namespace sprung
