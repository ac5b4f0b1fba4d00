#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Full bricks for a box (sides in m) with its middle at the origin.
/// Throws Error(kBadInput) where a side is no whole number of bricks.
[[nodiscard]] BrickGrid box_grid(const Vec3& sides, double brick_size);

/// The outer faces of bricks, two triangles each, m.
[[nodiscard]] SurfaceMesh surface_of(const BrickGrid& grid);

}  // namespace sprung
