#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/solids.h"

namespace sprung {

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
