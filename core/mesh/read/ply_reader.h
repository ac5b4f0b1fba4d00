#pragma once
#include <string>
#include <string_view>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The mesh in the bytes of a PLY file, text or binary: positions, normals, UVs of vertices or of the corners of faces,
/// colours, triangle strips, and the name of a texture. Other elements and properties are passed over. `name` is that
/// of the file, for messages. Throws Error(kBadInput) naming vertex or face, before anything is allocated that the
/// bytes could not hold.
[[nodiscard]] SurfaceMesh read_ply(std::string_view bytes, const std::string& name);

}  // namespace sprung
