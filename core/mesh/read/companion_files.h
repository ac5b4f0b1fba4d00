#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The text of a small file that a mesh names, as a material library; nothing where it is not there, or too large.
[[nodiscard]] std::optional<std::string> read_companion(const std::string& name,
                                                        const std::filesystem::path& mesh_file);

/// Reads the pictures that the materials name and do not hold. They are looked for where the mesh says, then by name
/// beside it. One that cannot be found or read is left out with a note.
void read_textures(SurfaceMesh& mesh, const std::filesystem::path& mesh_file);

}  // namespace sprung
