#pragma once
#include "core/mesh/repair/solids.h"

namespace sprung {

/// The drawn surface of a solid: the triangles of the mesh that bound it, with their vertices, order, normals, UVs,
/// colours, parts and materials, oriented outward; then, as a last part "cap", the triangles that fill its holes. A cap
/// has vertices and normals of its own; its UVs and colours are those of the nearest rim vertex, its material is that
/// of the first part.
[[nodiscard]] SurfaceMesh submesh(const SurfaceMesh& mesh, const Solid& solid);

}  // namespace sprung
