#pragma once
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// A mesh as it stands in one frame, in the world. What does not change is that of the mesh at rest.
struct PosedMesh {
  std::string name;
  const Skin* rest = nullptr;
  Eigen::Vector3f color{0.8F, 0.8F, 0.8F};  // sRGB, of what has no colours of its own
  Points positions;                         // n x 3, m
  Points normals;                           // n x 3, unit; 0 rows: the mesh has none
};

/// A part of a mesh that looks alike, with what is known of it; a mesh without parts is one.
struct PosedPart {
  std::string name;
  int first_triangle = 0;
  int triangle_count = 0;
  std::string material;                        // a name of its own among those of all meshes
  Eigen::Vector4f color{0.8F, 0.8F, 0.8F, 1};  // sRGB and opacity
  const SurfaceMaterial* source = nullptr;     // with a texture perhaps; null: none
};
[[nodiscard]] std::vector<PosedPart> parts_of(const PosedMesh& mesh);

/// ".png" or ".jpg" by the first bytes of an encoded picture; "" where it is neither.
[[nodiscard]] std::string ending_of_texture(const SurfaceMaterial& material);

/// The mesh's own normals; where it has none, sums of the triangles' normals at each vertex, by area, as unit vectors.
[[nodiscard]] Points shading_normals(const PosedMesh& mesh);

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
