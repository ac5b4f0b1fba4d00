#pragma once
#include <filesystem>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Reads a mesh by assimp without any of its post-processing, which asserts or crashes on damaged input: node
/// transforms are applied and polygons cut here. Every instance of a mesh becomes a part. Colours of glTF, which are
/// linear, are encoded to sRGB. Animations, skins and morph targets are left out with a note. What it reads is never
/// freed, and damaged files may crash it: run it by read_in_child. Throws Error(kBadInput), or std::bad_alloc.
[[nodiscard]] SurfaceMesh read_by_assimp(const std::filesystem::path& file);

}  // namespace sprung
