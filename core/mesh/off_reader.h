#pragma once
#include <filesystem>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads an OFF text file by CGAL: assimp 5.2 drops the last faces of files with blank lines inside.
/// Precondition: the file passed check_mesh_file. Throws Error(kBadInput).
[[nodiscard]] SurfaceMesh read_off(const std::filesystem::path& file);

}  // namespace sprung
