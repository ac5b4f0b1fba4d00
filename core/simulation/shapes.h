#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/surface_mesh.h"
#include "core/simulation/scene.h"

namespace sprung {

/// The bricks of a box (sides in m) centred at the origin. Throws Error(kBadInput) if a side is not a whole number of
/// bricks.
[[nodiscard]] BrickGrid box_grid(const Vec3& sides, double brick_size);

/// The outer faces of bricks, two triangles each, m.
[[nodiscard]] SurfaceMesh surface_of(const BrickGrid& grid);

/// Smooth closed meshes with normals, m, centred at the origin. Their vertices lie on the shape, so that they enclose
/// about 0.1 % less than it.
[[nodiscard]] SurfaceMesh mesh_of(const SphereShape& sphere);
[[nodiscard]] SurfaceMesh mesh_of(const CylinderShape& cylinder);
[[nodiscard]] SurfaceMesh mesh_of(const TorusShape& torus);
[[nodiscard]] SurfaceMesh mesh_of(const CapsuleShape& capsule);

/// A box centred at the origin, m; two triangles per side.
[[nodiscard]] SurfaceMesh box_mesh(const Vec3& sides);

}  // namespace sprung
