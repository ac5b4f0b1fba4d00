#pragma once
#include "core/mesh/repair/solids.h"

namespace sprung {

/// What is drawn of a solid: the mesh's own triangles that bound it, with their vertices, order, normals, UVs, colours,
/// parts and materials, turned outward as the solid has them; then, as a last part "cap", the triangles that close its
/// holes, so that nobody looks inside. A cap has vertices of its own with its own normals; its UVs and colours are
/// those of the nearest vertex at its rim, its material that of the first part.
[[nodiscard]] SurfaceMesh submesh(const SurfaceMesh& mesh, const Solid& solid);

}  // namespace sprung
