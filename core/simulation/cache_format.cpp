#include "core/simulation/cache_format.h"

#include <fmt/format.h>

namespace sprung {
namespace {

using Rows3 = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

std::string texture_name(const std::string& folder, std::size_t material) {
  return fmt::format("{}/textures/{}", folder, material + 1);
}

void write_materials(Hdf5Writer& hdf5, const std::string& folder, const std::vector<SurfaceMaterial>& materials) {
  std::vector<std::string> names;
  std::vector<std::string> texture_names;
  Floats4 colors(materials.size(), 4);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    names.push_back(materials[i].name);
    texture_names.push_back(materials[i].texture_name);
    colors.row(i) = materials[i].color;
    if (materials[i].texture.empty()) continue;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(materials[i].texture.data());
    hdf5.write(texture_name(folder, i), std::span(bytes, materials[i].texture.size()), {materials[i].texture.size()});
  }
  hdf5.write_texts(folder + "/material_names", names);
  hdf5.write_texts(folder + "/texture_names", texture_names);
  write_matrix(hdf5, folder + "/material_colors", colors);
}

std::vector<SurfaceMaterial> read_materials(const Hdf5Reader& hdf5, const std::string& folder) {
  const std::vector<std::string> names = hdf5.read_texts(folder + "/material_names");
  const std::vector<std::string> texture_names = hdf5.read_texts(folder + "/texture_names");
  const auto colors = read_matrix<Floats4>(hdf5, folder + "/material_colors");
  std::vector<SurfaceMaterial> materials(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    materials[i].name = names[i];
    materials[i].texture_name = texture_names.at(i);
    materials[i].color = colors.row(i);
    if (!hdf5.has(texture_name(folder, i))) continue;
    const std::vector<std::uint8_t> bytes = hdf5.read<std::uint8_t>(texture_name(folder, i)).values;
    for (const std::uint8_t byte : bytes) materials[i].texture.push_back(std::byte{byte});
  }
  return materials;
}

}  // namespace

void write_skin(Hdf5Writer& hdf5, const std::string& folder, const Skin& skin) {
  write_matrix(hdf5, folder + "/positions", skin.positions);
  write_matrix(hdf5, folder + "/normals", skin.normals);
  write_matrix(hdf5, folder + "/uvs", skin.uvs);
  write_matrix(hdf5, folder + "/colors", skin.colors);
  write_matrix(hdf5, folder + "/triangles", skin.triangles);
  std::vector<std::string> names;
  Rows3 parts(skin.parts.size(), 3);  // first triangle, count, material
  for (std::size_t i = 0; i < skin.parts.size(); ++i) {
    const Part& part = skin.parts[i];
    names.push_back(part.name);
    parts.row(i) << part.first_triangle, part.triangle_count, part.material;
  }
  hdf5.write_texts(folder + "/part_names", names);
  write_matrix(hdf5, folder + "/parts", parts);
  write_materials(hdf5, folder, skin.materials);
}

Skin read_skin(const Hdf5Reader& hdf5, const std::string& folder) {
  Skin skin;
  skin.positions = read_matrix<Points>(hdf5, folder + "/positions");
  skin.normals = read_matrix<Points>(hdf5, folder + "/normals");
  skin.uvs = read_matrix<Floats2>(hdf5, folder + "/uvs");
  skin.colors = read_matrix<Floats4>(hdf5, folder + "/colors");
  skin.triangles = read_matrix<Triangles>(hdf5, folder + "/triangles");
  const std::vector<std::string> names = hdf5.read_texts(folder + "/part_names");
  const auto parts = read_matrix<Rows3>(hdf5, folder + "/parts");
  for (Eigen::Index i = 0; i < parts.rows(); ++i) {
    skin.parts.push_back(
        {.name = names.at(i), .first_triangle = parts(i, 0), .triangle_count = parts(i, 1), .material = parts(i, 2)});
  }
  skin.materials = read_materials(hdf5, folder);
  return skin;
}

}  // namespace sprung
