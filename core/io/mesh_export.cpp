#include "core/io/mesh_export.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <set>

#include "core/error.h"
#include "core/files.h"

namespace sprung {

std::vector<PosedPart> parts_of(const PosedMesh& mesh) {
  std::vector<Part> parts = mesh.rest->parts;
  if (parts.empty()) {
    parts.push_back({.name = mesh.name, .first_triangle = 0, .triangle_count = int(mesh.rest->triangles.rows())});
  }
  std::vector<PosedPart> all;
  for (const Part& part : parts) {
    PosedPart posed{.name = part.name.empty() ? mesh.name : part.name,
                    .first_triangle = part.first_triangle,
                    .triangle_count = part.triangle_count,
                    .material = mesh.name + " skin"};
    posed.color << mesh.color, 1;
    if (mesh.rest->colors.rows() > 0) posed.color.setOnes();  // which programs multiply by vertex colours
    if (part.material >= 0) {
      posed.source = &mesh.rest->materials[part.material];
      posed.color = posed.source->color;
      posed.material = posed.source->name.empty() ? mesh.name + " " + std::to_string(part.material + 1)
                                                  : mesh.name + " " + posed.source->name;
    }
    all.push_back(std::move(posed));
  }
  return all;
}

std::string texture_extension(const SurfaceMaterial& material) {
  const std::vector<std::byte>& bytes = material.texture;
  if (bytes.size() < 4) return "";
  if (bytes[0] == std::byte{0x89} && bytes[1] == std::byte{'P'}) return ".png";
  if (bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8}) return ".jpg";
  return "";
}

Points shading_normals(const PosedMesh& mesh) {
  if (mesh.normals.rows() > 0) return mesh.normals;
  const Points& positions = mesh.positions;
  Points sums = Points::Zero(positions.rows(), 3);
  for (const auto& t : mesh.rest->triangles.rowwise()) {
    const Eigen::RowVector3d a = positions.row(t[0]);
    const Eigen::RowVector3d normal = (positions.row(t[1]) - a).cross(positions.row(t[2]) - a);
    for (const int corner : t) sums.row(corner) += normal;
  }
  for (auto sum : sums.rowwise()) {
    if (sum.norm() > 0) {
      sum.normalize();
    } else {
      sum = Eigen::RowVector3d::UnitY();
    }
  }
  return sums;
}

namespace {

constexpr std::size_t kMost3dsVertices = 65535;

constexpr MeshContent kEverything{true, true, true, true, true, true};

constexpr std::array<MeshFormat, 9> kFormats{{
    {".obj", "Wavefront OBJ, materials in .mtl", "", kEverything},
    // assimp's binary files declare bytes for colours and hold floats, and one in 256 it misreads itself.
    {".ply", "Stanford PLY, text, one object", "ply", {.normals = true, .uvs = true, .colors = true}},
    {".stl", "STL, binary, triangles only", "stlb", {}},
    {".glb", "glTF 2 in one file", "glb2", kEverything},
    {".gltf", "glTF 2 with .bin beside it", "gltf2", kEverything},
    {".fbx", "Autodesk FBX, as text (Blender reads binary ones only)", "fbxa", kEverything},
    {".dae", "Collada", "collada", kEverything},
    {".3ds",
     "3D Studio, at most 65535 vertices a part",
     "3ds",
     {.uvs = true, .materials = true},
     kMost3dsVertices,
     true,
     true},
    {".x3d", "X3D", "x3d", {.normals = true, .uvs = true, .colors = true, .materials = true}},
}};

constexpr std::array<UnsupportedFormat, 6> kUnsupported{{
    {"fbx (binary)", "assimp's binary files cannot be read back, not by itself either"},
    {"3mf", "geometry only, and assimp's own importer stops at some of its files"},
    {"gltf 1 (gltf, glb)", "no colours and materials; .gltf and .glb are glTF 2 here"},
    {"x", "assimp's importer hangs on it too easily"},
    {"stp, pbrt", "cannot be read back"},
    {"assbin, assxml, assjson", "dumps of assimp's memory that nothing else reads"},
}};

std::vector<PosedMesh> z_up_from_y_up(std::vector<PosedMesh> meshes) {
  for (PosedMesh& mesh : meshes) {
    for (Points* points : {&mesh.positions, &mesh.normals}) {
      points->col(1).swap(points->col(2));
      points->col(1) *= -1;
    }
  }
  return meshes;
}

std::array<std::pair<std::string_view, bool>, 6> list_of(const MeshContent& content) {
  return {{{"normals", content.normals},
           {"UVs", content.uvs},
           {"colours of vertices", content.colors},
           {"materials", content.materials},
           {"textures", content.textures},
           {"part names", content.part_names}}};
}

MeshContent content_of(const PosedMesh& mesh) {
  const Skin& rest = *mesh.rest;
  const auto has_texture = [](const SurfaceMaterial& material) { return !material.texture.empty(); };
  return {.normals = mesh.normals.rows() > 0,
          .uvs = rest.uvs.rows() > 0,
          .colors = rest.colors.rows() > 0,
          .materials = !rest.materials.empty(),
          .textures = std::any_of(rest.materials.begin(), rest.materials.end(), has_texture),
          .part_names = rest.parts.size() > 1};
}

}  // namespace

std::string describe(const MeshContent& content) {
  std::string names;
  for (const auto& [name, is_there] : list_of(content)) {
    if (is_there) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

std::string lost_content(const MeshFormat& format, const std::vector<PosedMesh>& meshes) {
  MeshContent lost;
  for (const PosedMesh& mesh : meshes) {
    const MeshContent content = content_of(mesh);
    lost.normals |= content.normals && !format.keeps.normals;
    lost.uvs |= content.uvs && !format.keeps.uvs;
    lost.colors |= content.colors && !format.keeps.colors;
    lost.materials |= content.materials && !format.keeps.materials;
    lost.textures |= content.textures && !format.keeps.textures;
    lost.part_names |= content.part_names && !format.keeps.part_names;
  }
  return describe(lost);
}

std::span<const MeshFormat> mesh_formats() { return kFormats; }

std::span<const UnsupportedFormat> unsupported_formats() { return kUnsupported; }

const MeshFormat* find_mesh_format(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const auto* found = std::find_if(kFormats.begin(), kFormats.end(),
                                   [&](const MeshFormat& format) { return format.extension == extension; });
  return found == kFormats.end() ? nullptr : found;
}

void export_meshes(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file) {
  const MeshFormat* format = find_mesh_format(file);
  if (format == nullptr) throw Error(ErrorKind::kUsage, fmt::format("'{}': no known format", file.string()));
  for (const PosedMesh& mesh : meshes) {
    const std::size_t count = mesh.positions.rows();
    if (format->max_vertices == 0 || count <= format->max_vertices) continue;
    throw Error(ErrorKind::kBadInput, fmt::format("{} has {} vertices, more than the {} that {} files can hold",
                                                  mesh.name, count, format->max_vertices, format->extension));
  }
  if (format->writer.empty()) return write_obj(meshes, file);
  write_by_assimp(format->is_z_up ? z_up_from_y_up(meshes) : meshes, *format, file);
}

std::string write_texture(const PosedPart& part, const std::filesystem::path& file) {
  if (part.source == nullptr) return "";
  const std::string extension = texture_extension(*part.source);
  if (extension.empty()) return "";
  std::string name = part.material + extension;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '.'; }, '_');
  const std::filesystem::path place = file.parent_path() / name;
  const auto size = part.source->texture.size();
  if (std::filesystem::exists(place) && std::filesystem::file_size(place) == size) return name;
  write_file(place, {reinterpret_cast<const char*>(part.source->texture.data()), size});
  return name;
}

namespace {

/// Names in OBJ files end at the first space.
std::string one_word(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isspace(letter) != 0; }, '_');
  return name;
}

void add_vertices(const PosedMesh& mesh, std::string& text) {
  auto out = std::back_inserter(text);
  const bool has_colors = mesh.rest->colors.rows() > 0;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const auto p = mesh.positions.row(i);
    fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}", p[0], p[1], p[2]);
    if (has_colors) {
      const auto color = mesh.rest->colors.row(i);
      fmt::format_to(out, " {:.6g} {:.6g} {:.6g}", color[0], color[1], color[2]);
    }
    text += '\n';
  }
  for (const auto& uv : mesh.rest->uvs.rowwise()) fmt::format_to(out, "vt {:.9g} {:.9g}\n", uv[0], uv[1]);
  for (const auto& n : mesh.normals.rowwise()) fmt::format_to(out, "vn {:.7g} {:.7g} {:.7g}\n", n[0], n[1], n[2]);
}

/// Indices of a mesh's first vertex, UV and normal, which OBJ counts through the whole file.
struct FirstIndices {
  int vertex = 1;
  int uv = 1;
  int normal = 1;
};

void add_triangles(const PosedMesh& mesh, const PosedPart& part, const FirstIndices& first, std::string& text) {
  const bool has_uvs = mesh.rest->uvs.rows() > 0;
  const bool has_normals = mesh.normals.rows() > 0;
  auto out = std::back_inserter(text);
  for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
    text += 'f';
    for (const int corner : mesh.rest->triangles.row(t)) {
      fmt::format_to(out, " {}", first.vertex + corner);
      if (has_uvs || has_normals) text += '/';
      if (has_uvs) fmt::format_to(out, "{}", first.uv + corner);
      if (has_normals) fmt::format_to(out, "/{}", first.normal + corner);
    }
    text += '\n';
  }
}

std::string material_text(const PosedPart& part, const std::filesystem::path& file) {
  const std::string texture = write_texture(part, file);
  // Here a texture is multiplied by the colour; most programs that read OBJ files let it replace the colour.
  return fmt::format("newmtl {}\nKd {:.6g} {:.6g} {:.6g}\nd {:.6g}\n{}\n", one_word(part.material), part.color[0],
                     part.color[1], part.color[2], part.color[3],
                     texture.empty() ? "" : fmt::format("map_Kd {}\n", texture));
}

}  // namespace

void write_obj(const std::vector<PosedMesh>& meshes, const std::filesystem::path& file) {
  const std::filesystem::path materials = std::filesystem::path(file).replace_extension(".mtl");
  std::string text = fmt::format("mtllib {}\n", materials.filename().string());
  std::string material_texts;
  std::set<std::string> known;
  FirstIndices first;
  for (const PosedMesh& mesh : meshes) {
    text += fmt::format("o {}\n", one_word(mesh.name));
    add_vertices(mesh, text);
    for (const PosedPart& part : parts_of(mesh)) {
      if (known.insert(part.material).second) material_texts += material_text(part, file);
      text += fmt::format("g {}\nusemtl {}\n", one_word(part.name), one_word(part.material));
      add_triangles(mesh, part, first, text);
    }
    first.vertex += int(mesh.positions.rows());
    first.uv += int(mesh.rest->uvs.rows());
    first.normal += int(mesh.normals.rows());
  }
  write_file(materials, material_texts);
  write_file(file, text);
}

}  // namespace sprung
