#pragma once
#include "core/bricks/brick_grid.h"
#include "core/bricks/column_caster.h"
#include "core/mesh/repair/solids.h"

namespace sprung {

/// Sets `sums` to the share of each cell where the triangles' generalised winding number is beyond 1/2, whichever way
/// they are turned: for surfaces with gaps, where rays leak. Cells that a triangle may touch are sampled at 64 points,
/// others at their middle, or 64 together where none of them is near a triangle or a gap. Works in parallel;
/// deterministic. Cost: some 60 microseconds a cell at the surface.
void fill_by_winding(const CellSurface& surface, CellSums& sums);

/// Sets `sums` to the share of each cell that lies within half of `thickness` (in cells, > 0) from the triangles, at 64
/// points a cell. A shell thinner than a cell is sampled as if it were one cell thick, and the shares are reduced to
/// its thickness: so its cells still hang together by faces, and hold its mass. Deterministic.
void fill_shell(const CellSurface& surface, double thickness, CellSums& sums);

/// The bricks of side `brick_size` that a solid touches, with the fraction of each that is solid. The lattice starts
/// at the low corner of the solid's bounding box; a box that is a whole number of bricks long gets exactly those.
/// Cells whose fill is below 1e-6 are left out. Deterministic. Cost: one pass over the triangles and the cells.
/// Memory: 8 bytes for every cell of the box, filled or not. Volume: exact (the fill of cut bricks is scaled by one
/// factor) where the samples agree with solid.volume within 0.5 % and the surface does not overlap itself; else the
/// volume that is inside at all. Loose triangles (not solid.closed) enclose what their winding number says
/// (winding_cells.h); a shell of solid.thickness is centred on its triangles (shell_cells.h), the lattice begins half
/// of that lower, and its bricks hang together by faces. Precondition: brick_size > 0. Throws Error(kBadInput) where
/// the box would be more than 2^16 cells long or hold more than 2^31.
[[nodiscard]] BrickGrid voxelize(const Solid& solid, double brick_size);

/// The volume that a solid encloses, overlaps once: solid.volume unless it overlaps itself or is not closed, then that
/// of 128 cells along its longest side, right to 1e-3.
[[nodiscard]] double enclosed_volume(const Solid& solid);

}  // namespace sprung
