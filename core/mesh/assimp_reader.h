#pragma once
#include <filesystem>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads a mesh by assimp without any of its post-processing, which asserts or crashes on damaged input: node
/// transforms are applied and polygons cut here. Every instance of a mesh becomes a part. Colours of glTF, which are
/// linear, are encoded to sRGB. Precondition: the file passed check_mesh_file. Throws Error(kBadInput).
[[nodiscard]] SurfaceMesh read_by_assimp(const std::filesystem::path& file);

}  // namespace sprung
