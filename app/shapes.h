#pragma once
#include "app/scene/scene.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Smooth closed meshes with normals, m, their middles at the origin. Their corners lie on the shape, so that they hold
/// about 0.1 % less than it.
[[nodiscard]] SurfaceMesh mesh_of(const SphereShape& sphere);
[[nodiscard]] SurfaceMesh mesh_of(const CylinderShape& cylinder);
[[nodiscard]] SurfaceMesh mesh_of(const TorusShape& torus);
[[nodiscard]] SurfaceMesh mesh_of(const CapsuleShape& capsule);

/// A box with its middle at the origin, m; two triangles a side.
[[nodiscard]] SurfaceMesh box_mesh(const Vec3& sides);

}  // namespace sprung
