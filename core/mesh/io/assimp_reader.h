#pragma once
#include <string>
#include <vector>

#include "core/mesh/surface_mesh.h"

struct aiScene;

namespace sprung {

/// A linear colour value encoded to sRGB.
[[nodiscard]] float srgb_from_linear(float linear);

/// The materials of a scene, with the bytes of embedded textures and the names of those in files. An embedded texture
/// that cannot be read is left out with a note.
[[nodiscard]] std::vector<SurfaceMaterial> read_materials(const aiScene& scene, bool is_gltf,
                                                          std::vector<std::string>& notes);

/// True for a material that only assimp made up, where the file gives none.
[[nodiscard]] bool is_placeholder(const aiScene& scene, unsigned material, bool is_gltf);

}  // namespace sprung
