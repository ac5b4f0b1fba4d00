#pragma once
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/output/mesh_export.h"

namespace sprung {

/// OBJ with its materials in a file of the same name ending in .mtl. assimp's writer would merge equal positions.
void write_obj(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file);

/// Everything else.
void write_by_assimp(const std::vector<PosedMesh>& meshes, const MeshFormat& format, const std::filesystem::path& file);

/// Writes beside the name and renames. Throws Error(kFailed).
void write_bytes(const std::filesystem::path& file, std::string_view bytes);
/// The same for bytes that lie in several places.
void write_pieces(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces);

/// Writes the texture of a part beside a file and returns its name there; "" where it has none that is known. Frames of
/// one film share it.
[[nodiscard]] std::string write_texture(const PosedPart& part, const std::filesystem::path& file);

}  // namespace sprung
