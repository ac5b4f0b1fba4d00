#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/surface_mesh.h"
#include "core/simulation/scene.h"

namespace sprung {

/// Full bricks for a box (sides in m) with its middle at the origin.
/// Throws Error(kBadInput) where a side is no whole number of bricks.
[[nodiscard]] BrickGrid box_grid(const Vec3& sides, double brick_size);

/// The outer faces of bricks, two triangles each, m.
[[nodiscard]] SurfaceMesh surface_of(const BrickGrid& grid);

/// Smooth closed meshes with normals, m, their middles at the origin. Their corners lie on the shape, so that they hold
/// about 0.1 % less than it.
[[nodiscard]] SurfaceMesh mesh_of(const SphereShape& sphere);
[[nodiscard]] SurfaceMesh mesh_of(const CylinderShape& cylinder);
[[nodiscard]] SurfaceMesh mesh_of(const TorusShape& torus);
[[nodiscard]] SurfaceMesh mesh_of(const CapsuleShape& capsule);

/// A box with its middle at the origin, m; two triangles a side.
[[nodiscard]] SurfaceMesh box_mesh(const Vec3& sides);

}  // namespace sprung
