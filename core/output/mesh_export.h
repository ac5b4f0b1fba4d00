#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/output/posed_mesh.h"

namespace sprung {

/// What a mesh may have beside positions and triangles.
struct MeshContent {
  bool normals = false;
  bool uvs = false;
  bool colors = false;  // of vertices
  bool materials = false;
  bool textures = false;
  bool part_names = false;
};

/// "normals, UVs"; empty where there is nothing.
[[nodiscard]] std::string names_of(const MeshContent& content);

/// A file format for one frame's meshes. All keep positions, triangles and their order.
struct MeshFormat {
  std::string_view ending;        // ".obj"
  std::string_view what;          // for a person
  std::string_view writer;        // assimp's name of it; empty: this project's own
  MeshContent keeps;              // what others find in its files
  std::size_t most_vertices = 0;  // of a part; 0: no limit
  bool is_z_up = false;           // whoever reads it turns it
  bool is_flat = false;           // its writer takes nodes in any order, so that there may be one only
};

/// Those that were found to come back from their files as they went in.
[[nodiscard]] std::span<const MeshFormat> mesh_formats();

/// Formats that assimp writes and this does not, with the reason.
struct LeftOut {
  std::string_view format;
  std::string_view reason;
};
[[nodiscard]] std::span<const LeftOut> left_out_formats();

/// What these meshes have and the format cannot keep: "textures, part names"; empty where nothing is lost.
[[nodiscard]] std::string lost_in(const MeshFormat& format, const std::vector<PosedMesh>& meshes);

/// By the ending of a file, whatever its case; null where there is none.
[[nodiscard]] const MeshFormat* find_mesh_format(const std::filesystem::path& file);

/// Writes beside the name and renames; textures and materials that the format wants in files of their own go beside it.
/// Throws Error(kFailed), Error(kBadInput) where the meshes are too large for the format.
void export_meshes(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file);

}  // namespace sprung
