#pragma once
#include <vector>

#include "app/scene/scene.h"
#include "core/bricks/brick_grid.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Full bricks for a box with its middle at the origin, less the bricks that the cuts take.
/// Throws Error(kBadInput) where a side is no whole number of bricks, or nothing is left.
[[nodiscard]] BrickGrid box_grid(const Vec3& sides, double brick_size, const std::vector<Cut>& cuts);

/// The outer faces of bricks, two triangles each, m.
[[nodiscard]] SurfaceMesh surface_of(const BrickGrid& grid);

}  // namespace sprung
