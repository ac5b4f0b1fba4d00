#pragma once
#include "core/bricks/brick_grid.h"
#include "core/bricks/column_caster.h"
#include "core/mesh/repair/solids.h"

namespace sprung {

/// Sets `sums` to the fraction of each cell where the generalised winding number exceeds 1/2 in absolute value: for
/// surfaces with gaps, through which rays leak. Cells that a triangle may touch are sampled at 64 points, others at
/// their centre, or 64 together where none of them is near a triangle or a gap. Parallel; deterministic. Cost: some 60
/// microseconds per cell at the surface.
void fill_by_winding(const CellSurface& surface, CellSums& sums);

/// Sets `sums` to the fraction of each cell within half of `thickness` (in cells, > 0) of the triangles, by 64 points
/// per cell. A shell thinner than a cell is sampled as if it were one cell thick, and the fractions are scaled to its
/// thickness: its cells stay connected through faces and have the right mass. Deterministic.
void fill_shell(const CellSurface& surface, double thickness, CellSums& sums);

/// The bricks of side `brick_size` that overlap a solid, with the fraction of each that is solid. The lattice starts at
/// the low corner of the solid's bounding box; a box a whole number of bricks long gets exactly those. Cells with a
/// fill below 1e-6 are dropped. Deterministic. Cost: one pass over the triangles and the cells. Memory: 8 bytes per
/// cell of the bounding box. Volume: exact (the fill of cut bricks is scaled by one factor) if the samples agree with
/// solid.volume within 0.5 % and the surface does not overlap itself; else the volume of non-zero winding number.
/// Unconnected triangles (not solid.closed) are filled by winding number (fill_by_winding); a shell of solid.thickness
/// is centred on its triangles (fill_shell), its lattice starts half of that lower, and its bricks are connected
/// through faces. Precondition: brick_size > 0. Throws Error(kBadInput) if the box would be more than 2^16 cells long
/// or hold more than 2^31.
[[nodiscard]] BrickGrid voxelize(const Solid& solid, double brick_size);

/// The volume enclosed by a solid, overlaps counted once: solid.volume unless it overlaps itself or is not closed; then
/// that of 128 cells along its longest side, accurate to 1e-3.
[[nodiscard]] double enclosed_volume(const Solid& solid);

}  // namespace sprung
