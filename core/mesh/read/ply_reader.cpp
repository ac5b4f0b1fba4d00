#include "core/mesh/read/ply_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <span>

#include "core/mesh/read/ply_data.h"
#include "core/mesh/read/polygon_soup.h"

namespace sprung {
namespace {

/// Where a vertex has what, by the places of the properties; -1: not there.
struct VertexPlaces {
  explicit VertexPlaces(const PlyElement& element)
      : position{element.find({"x"}), element.find({"y"}), element.find({"z"})},
        normal{element.find({"nx", "normal_x"}), element.find({"ny", "normal_y"}), element.find({"nz", "normal_z"})},
        uv{element.find({"u", "s", "texture_u", "texture_s", "tx"}),
           element.find({"v", "t", "texture_v", "texture_t", "ty"})},
        color{element.find({"red", "diffuse_red", "r"}), element.find({"green", "diffuse_green", "g"}),
              element.find({"blue", "diffuse_blue", "b"})},
        alpha(element.find({"alpha", "diffuse_alpha", "a"})) {}

  std::array<int, 3> position;
  std::array<int, 3> normal;
  std::array<int, 2> uv;
  std::array<int, 3> color;
  int alpha;
};

template <std::size_t n>
bool has_all(const std::array<int, n>& places) {
  return std::all_of(places.begin(), places.end(), [](int place) { return place >= 0; });
}

/// Colours in whole numbers are bytes, or words of 16 bits.
double full_scale(PlyType type) {
  if (type == PlyType::kFloat32 || type == PlyType::kFloat64) return 1;
  return type == PlyType::kUint16 ? 65535 : 255;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name)
      : name_(name), header_(read_ply_header(bytes, name)), data_(bytes, header_, name) {
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") continue;
      if (vertices_ >= 0) data_.refuse("has more than one element 'vertex'");
      vertices_ = element.count;
    }
    soup_.parts.push_back({.name = std::filesystem::path(name).stem().string()});
    if (!header_.texture.empty()) {
      SurfaceMaterial& material = soup_.materials.emplace_back();
      material.name = "texture";
      material.color.setOnes();
      material.texture_name = header_.texture;
      soup_.parts[0].material = 0;
    }
  }

  SurfaceMesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        if (element.name == "edge") soup_.lines = element.count;
        read_all(element, [](const Named&) {});
      }
    }
    // Where faces stand before the vertices, their corners do not know yet what these have.
    for (Corner& corner : soup_.corners) {
      if (has_vertex_uvs_ && corner.uv < 0) corner.uv = corner.position;
      if (has_normals_) corner.normal = corner.position;
    }
    return mesh_from(std::move(soup_), name_);
  }

 private:
  template <class Use>
  void read_all(const PlyElement& element, const Use& use) {
    for (long i = 0; i < element.count; ++i) {
      const Named what{element.name, i + 1};
      data_.read(element, what, entry_);
      use(what);
    }
  }

  [[nodiscard]] double number(int place) const { return entry_.numbers[static_cast<std::size_t>(place)]; }

  void read_vertices(const PlyElement& element) {
    const VertexPlaces places(element);
    if (!has_all(places.position)) data_.refuse("its vertices have no x, y and z");
    has_normals_ = has_all(places.normal);
    has_vertex_uvs_ = has_all(places.uv) && !has_corner_uvs();
    const auto type = [&](int place) { return element.properties[static_cast<std::size_t>(place)].type; };
    soup_.single_precision = header_.format != PlyFormat::kText && type(places.position[0]) == PlyType::kFloat32;
    const double scale = has_all(places.color) ? full_scale(type(places.color[0])) : 1;
    read_all(element, [&](const Named&) {
      const auto& p = places.position;
      add_position(soup_, {number(p[0]), number(p[1]), number(p[2])}, name_);
      const auto& n = places.normal;
      if (has_normals_) add_normal(soup_, {number(n[0]), number(n[1]), number(n[2])});
      if (has_vertex_uvs_) add_uv(soup_, {number(places.uv[0]), number(places.uv[1])});
      if (has_all(places.color)) add_color(places, scale);
    });
  }

  void add_color(const VertexPlaces& places, double scale) {
    Eigen::Vector4d color(number(places.color[0]), number(places.color[1]), number(places.color[2]),
                          places.alpha < 0 ? scale : number(places.alpha));
    color /= scale;
    if (!color.allFinite()) color.setOnes();
    soup_.colors.emplace_back(color.cwiseMax(0).cwiseMin(1).cast<float>());
  }

  [[nodiscard]] bool has_corner_uvs() const {
    return std::any_of(header_.elements.begin(), header_.elements.end(), [](const PlyElement& element) {
      return element.name == "face" && element.find({"texcoord", "texture_coordinates"}) >= 0;
    });
  }

  int row_of(double vertex, const Named& what) const {
    if (vertex >= 0 && vertex < static_cast<double>(vertices_) && vertex == std::floor(vertex)) {
      return static_cast<int>(vertex);
    }
    data_.refuse(fmt::format("{} refers to vertex {}, but they run from 0 to {} (index out of range)", what.text(),
                             vertex, vertices_ - 1));
  }

  void add_polygon(std::span<const double> vertices, std::span<const double> uvs, const Named& what) {
    if (vertices.size() < 3) return;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Corner corner{.position = row_of(vertices[i], what)};
      if (uvs.size() == 2 * vertices.size()) {
        corner.uv = static_cast<int>(soup_.uvs.size());
        add_uv(soup_, {uvs[2 * i], uvs[2 * i + 1]});
      }
      soup_.corners.push_back(corner);
    }
    soup_.corner_counts.push_back(static_cast<int>(vertices.size()));
    soup_.polygon_parts.push_back(0);
  }

  int list_place(const PlyElement& element) {
    const int place = element.find({"vertex_indices", "vertex_index"});
    if (place < 0 || !element.properties[static_cast<std::size_t>(place)].is_list) {
      data_.refuse(fmt::format("the element '{}' has no list of vertex_indices", element.name));
    }
    return place;
  }

  void read_faces(const PlyElement& element) {
    if (element.count == 0) return;
    const auto vertices = static_cast<std::size_t>(list_place(element));
    const int uvs = element.find({"texcoord", "texture_coordinates"});
    read_all(element, [&](const Named& what) {
      std::span<const double> corner_uvs;
      if (uvs >= 0) corner_uvs = entry_.lists[static_cast<std::size_t>(uvs)];
      add_polygon(entry_.lists[vertices], corner_uvs, what);
    });
  }

  /// Each vertex of a strip makes a triangle with the two before it, turned over every other time; -1 begins anew.
  void read_strips(const PlyElement& element) {
    if (element.count == 0) return;
    const auto place = static_cast<std::size_t>(list_place(element));
    read_all(element, [&](const Named& what) {
      const std::vector<double>& strip = entry_.lists[place];
      std::size_t begin = 0;
      for (std::size_t i = 0; i < strip.size(); ++i) {
        if (strip[i] == -1) begin = i + 1;
        if (i < begin + 2) continue;
        const bool is_even = (i - begin) % 2 == 0;
        const std::array triangle{strip[is_even ? i - 2 : i - 1], strip[is_even ? i - 1 : i - 2], strip[i]};
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
          add_polygon(triangle, {}, what);
        }
      }
    });
  }

  const std::string& name_;
  PlyHeader header_;
  PlyData data_;
  PlyEntry entry_;
  PolygonSoup soup_;
  long vertices_ = -1;  // none declared yet
  bool has_normals_ = false;
  bool has_vertex_uvs_ = false;
};

}  // namespace

SurfaceMesh read_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace sprung
