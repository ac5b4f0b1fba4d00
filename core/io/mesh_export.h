#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// A mesh in one frame, in the world.
struct PosedMesh {
  std::string name;
  const Skin* rest = nullptr;               // gives triangles, parts, materials, UVs and colours
  Eigen::Vector3f color{0.8F, 0.8F, 0.8F};  // sRGB, where the mesh has no colours
  Points positions;                         // n x 3, m
  Points normals;                           // n x 3, unit; 0 rows: none
};

/// Triangles of one material. A mesh without parts is a single one.
struct PosedPart {
  std::string name;
  int first_triangle = 0;
  int triangle_count = 0;
  std::string material;                        // unique among all meshes
  Eigen::Vector4f color{0.8F, 0.8F, 0.8F, 1};  // sRGB and opacity
  const SurfaceMaterial* source = nullptr;     // null: none
};
[[nodiscard]] std::vector<PosedPart> parts_of(const PosedMesh& mesh);

/// The roughness of all materials, in formats that have it.
inline constexpr float kExportedRoughness = 0.6F;

/// ".png" or ".jpg" by the first bytes of the texture; "" if it is neither.
[[nodiscard]] std::string texture_extension(const SurfaceMaterial& material);

/// The mesh's own normals; if it has none, area-weighted vertex normals.
[[nodiscard]] Points shading_normals(const PosedMesh& mesh);

/// The data that a mesh may have besides positions and triangles.
struct MeshContent {
  bool normals = false;
  bool uvs = false;
  bool colors = false;  // of vertices
  bool materials = false;
  bool textures = false;
  bool part_names = false;
};

/// "normals, UVs"; empty for nothing.
[[nodiscard]] std::string describe(const MeshContent& content);

/// A file format for the meshes of one frame. All preserve positions, triangles and their order.
struct MeshFormat {
  std::string_view extension;    // ".obj"
  std::string_view what;         // for messages
  std::string_view writer;       // assimp's name of its writer; empty: ours
  MeshContent keeps;             // what readers find in its files
  std::size_t max_vertices = 0;  // per part; 0: no limit
  bool is_z_up = false;          // by convention of its readers
  bool is_flat = false;          // its writer reorders nodes, so all meshes go into one
};

/// The formats that round-trip, as the tests verify.
[[nodiscard]] std::span<const MeshFormat> mesh_formats();

/// A format that assimp could write but that is not offered, and why.
struct UnsupportedFormat {
  std::string_view format;
  std::string_view reason;
};
[[nodiscard]] std::span<const UnsupportedFormat> unsupported_formats();

/// Lists what these meshes have and the format cannot hold: "textures, part names"; empty if nothing is lost.
[[nodiscard]] std::string lost_content(const MeshFormat& format, const std::vector<PosedMesh>& meshes);

/// Returns the format with the extension of a file, ignoring case; null for an unknown one.
[[nodiscard]] const MeshFormat* find_mesh_format(const std::filesystem::path& file);

/// Writes by way of a PartialFile; textures and materials that the format keeps in separate files go beside it.
/// Throws Error(kFailed), Error(kBadInput) if the meshes exceed the limits of the format.
void export_meshes(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file);

/// OBJ with a material library (.mtl) of the same name. assimp's writer would merge equal positions.
void write_obj(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file);

/// All other formats.
void write_by_assimp(const std::vector<PosedMesh>& meshes, const MeshFormat& format, const std::filesystem::path& file);

/// Writes the texture of a part beside a file and returns its name; "" if the part has none of a known format. Frames
/// of one animation share it.
[[nodiscard]] std::string write_texture(const PosedPart& part, const std::filesystem::path& file);

}  // namespace sprung
