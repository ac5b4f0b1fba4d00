#pragma once
#include <string>
#include <string_view>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The mesh in the bytes of an STL file, text or binary, whatever its first word is: a binary one may begin with
/// "solid", too. Each solid of a text is a part; colours of facets in binary files are kept, normals are not, since
/// they only repeat the triangles. Every triangle has vertices of its own. `name` is that of the file, for messages.
/// Throws Error(kBadInput).
[[nodiscard]] SurfaceMesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace sprung
