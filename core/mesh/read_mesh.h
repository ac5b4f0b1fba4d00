#pragma once
#include <filesystem>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads any mesh format that assimp knows (OFF by CGAL, since assimp drops faces there). Several meshes in a file
/// become parts; polygons are cut into triangles; textures are looked for beside the file.
/// Throws Error(kBadInput) naming file, reason and, where known, the place in it: missing, a directory, empty, not a
/// mesh, no faces, a coordinate that is not finite, an index out of range.
[[nodiscard]] SurfaceMesh read_mesh(const std::filesystem::path& file);

}  // namespace sprung
