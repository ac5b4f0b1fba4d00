#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "core/output/mesh_writers.h"

namespace sprung {
namespace {

/// Names in OBJ files end at the first blank.
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

/// The numbers of a body's first vertex, UV and normal, which a file counts through all its bodies.
struct Firsts {
  int vertex = 1;
  int uv = 1;
  int normal = 1;
};

void add_triangles(const PosedMesh& mesh, const PosedPart& part, const Firsts& firsts, std::string& text) {
  const bool has_uvs = mesh.rest->uvs.rows() > 0;
  const bool has_normals = mesh.normals.rows() > 0;
  auto out = std::back_inserter(text);
  for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
    text += 'f';
    for (const int corner : mesh.rest->triangles.row(t)) {
      fmt::format_to(out, " {}", firsts.vertex + corner);
      if (has_uvs || has_normals) text += '/';
      if (has_uvs) fmt::format_to(out, "{}", firsts.uv + corner);
      if (has_normals) fmt::format_to(out, "/{}", firsts.normal + corner);
    }
    text += '\n';
  }
}

std::string material_text(const PosedPart& part, const std::filesystem::path& file) {
  const std::string texture = write_texture(part, file);
  // A texture is multiplied by the colour here, and replaces it in most programs that read OBJ files.
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
  Firsts firsts;
  for (const PosedMesh& mesh : meshes) {
    text += fmt::format("o {}\n", one_word(mesh.name));
    add_vertices(mesh, text);
    for (const PosedPart& part : parts_of(mesh)) {
      if (known.insert(part.material).second) material_texts += material_text(part, file);
      text += fmt::format("g {}\nusemtl {}\n", one_word(part.name), one_word(part.material));
      add_triangles(mesh, part, firsts, text);
    }
    firsts.vertex += static_cast<int>(mesh.positions.rows());
    firsts.uv += static_cast<int>(mesh.rest->uvs.rows());
    firsts.normal += static_cast<int>(mesh.normals.rows());
  }
  write_bytes(materials, material_texts);
  write_bytes(file, text);
}

}  // namespace sprung
