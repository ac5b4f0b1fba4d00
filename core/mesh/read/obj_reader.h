#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Gives the text of a file that another one names; nothing where it is not there.
using FindText = std::function<std::optional<std::string>(const std::string& name)>;

/// The mesh in the text of an OBJ file: polygons with UVs, normals and colours of vertices; a part for each object or
/// group and material; materials from the libraries it names. `name` is that of the file, for messages. Throws
/// Error(kBadInput) with the line and the number of the vertex or the face, counted from 1.
[[nodiscard]] SurfaceMesh read_obj(std::string_view text, const std::string& name, const FindText& find_text);

}  // namespace sprung
