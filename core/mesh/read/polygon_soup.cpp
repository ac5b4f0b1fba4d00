#include "core/mesh/read/polygon_soup.h"

#include <fmt/format.h>

#include <limits>
#include <span>
#include <utility>

#include "core/count_of.h"
#include "core/error.h"
#include "core/mesh/read/polygon.h"

namespace sprung {
namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, reason));
}

/// The vertices of a mesh: for each position as many as it has different pairs of UV and normal.
class Vertices {
 public:
  explicit Vertices(std::size_t positions) : first_(positions, -1) {}

  /// A number for the corner's vertex, equal for equal corners.
  int find_or_add(const Corner& corner) {
    int& first = first_[static_cast<std::size_t>(corner.position)];
    for (int i = first; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
      const Corner& known = corners_[static_cast<std::size_t>(i)];
      if (known.uv == corner.uv && known.normal == corner.normal) return i;
    }
    next_.push_back(first);
    corners_.push_back(corner);
    return first = static_cast<int>(corners_.size()) - 1;
  }

  /// Positions that no corner uses become vertices, too.
  void add_unused() {
    for (std::size_t p = 0; p < first_.size(); ++p) {
      if (first_[p] < 0) static_cast<void>(find_or_add({static_cast<int>(p)}));
    }
  }

  /// Numbers the vertices anew in the order of their positions in the file; the rows by the old numbers.
  std::vector<int> rows() const {
    std::vector<int> rows(corners_.size());
    int row = 0;
    for (const int first : first_) {
      for (int i = first; i >= 0; i = next_[static_cast<std::size_t>(i)]) rows[static_cast<std::size_t>(i)] = row++;
    }
    return rows;
  }

  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

 private:
  std::vector<int> first_;  // of each position, -1: none
  std::vector<int> next_;   // of the same position
  std::vector<Corner> corners_;
};

template <class Rows, class List>
void fill_row(Rows& rows, int row, const List& list, int index) {
  if (rows.rows() > 0 && index >= 0) rows.row(row) = list[static_cast<std::size_t>(index)];
}

void fill_vertices(const PolygonSoup& soup, const Vertices& vertices, const std::vector<int>& rows, SurfaceMesh& mesh) {
  const auto count = static_cast<int>(rows.size());
  mesh.positions.resize(count, 3);
  if (!soup.colors.empty()) mesh.colors.resize(count, 4);
  if (!soup.uvs.empty()) mesh.uvs.setZero(count, 2);
  if (!soup.normals.empty()) mesh.normals.setZero(count, 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Corner& corner = vertices.corners()[i];
    fill_row(mesh.positions, rows[i], soup.positions, corner.position);
    fill_row(mesh.colors, rows[i], soup.colors, corner.position);
    fill_row(mesh.uvs, rows[i], soup.uvs, corner.uv);
    fill_row(mesh.normals, rows[i], soup.normals, corner.normal);
  }
}

/// The triangles of each part, corners by rows of the mesh.
std::vector<std::vector<std::array<int, 3>>> cut(const PolygonSoup& soup, const Points& positions,
                                                 const std::vector<int>& corner_rows) {
  std::vector<std::vector<std::array<int, 3>>> triangles(soup.parts.size());
  std::span<const int> left(corner_rows);
  for (std::size_t p = 0; p < soup.corner_counts.size(); ++p) {
    const auto count = static_cast<std::size_t>(soup.corner_counts[p]);
    cut_polygon(positions, left.first(count), triangles[static_cast<std::size_t>(soup.polygon_parts[p])]);
    left = left.subspan(count);
  }
  return triangles;
}

void fill_triangles(const std::vector<std::vector<std::array<int, 3>>>& triangles, std::vector<Part> parts,
                    SurfaceMesh& mesh) {
  std::size_t count = 0;
  for (const auto& of_part : triangles) count += of_part.size();
  mesh.triangles.resize(static_cast<int>(count), 3);
  int row = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (triangles[p].empty()) continue;
    parts[p].first_triangle = row;
    parts[p].triangle_count = static_cast<int>(triangles[p].size());
    for (const auto& corners : triangles[p]) mesh.triangles.row(row++) << corners[0], corners[1], corners[2];
    mesh.parts.push_back(std::move(parts[p]));
  }
}

}  // namespace

void add_position(PolygonSoup& soup, const Vec3& position, std::string_view name) {
  soup.positions.push_back(position);
  if (!position.allFinite()) {
    refuse(name, fmt::format("vertex {} has a coordinate that is not finite", soup.positions.size()));
  }
}

void add_uv(PolygonSoup& soup, const Eigen::Vector2d& uv) {
  const Eigen::Vector2f rounded = uv.cast<float>();
  soup.uvs.push_back(rounded.allFinite() ? rounded : Eigen::Vector2f::Zero());
}

void add_normal(PolygonSoup& soup, const Vec3& normal) {
  soup.normals.push_back(normal.allFinite() ? normal.stableNormalized().cast<float>().eval() : Eigen::Vector3f::Zero());
}

std::string no_faces(long points, long lines) {
  if (points == 0) return "no vertices and no faces: not a mesh of this format, or an empty one";
  const std::string held = count_of(points, "point");
  if (lines == 0) return fmt::format("no faces (a point cloud); it holds {}", held);
  return fmt::format("no faces (lines only); it holds {} and {}", held, count_of(lines, "line"));
}

SurfaceMesh mesh_from(PolygonSoup soup, std::string_view name) {
  if (soup.corner_counts.empty()) {
    refuse(name, no_faces(std::ssize(soup.positions), soup.lines));
  }
  if (soup.corners.size() > std::size_t{std::numeric_limits<int>::max()}) {
    refuse(name, "its faces have more than 2^31 corners; simplify the mesh");
  }
  Vertices vertices(soup.positions.size());
  std::vector<int> corner_rows;
  corner_rows.reserve(soup.corners.size());
  for (const Corner& corner : soup.corners) corner_rows.push_back(vertices.find_or_add(corner));
  vertices.add_unused();
  const std::vector<int> rows = vertices.rows();
  for (int& vertex : corner_rows) vertex = rows[static_cast<std::size_t>(vertex)];

  SurfaceMesh mesh;
  fill_vertices(soup, vertices, rows, mesh);
  const auto triangles = cut(soup, mesh.positions, corner_rows);
  fill_triangles(triangles, std::move(soup.parts), mesh);
  mesh.materials = std::move(soup.materials);
  mesh.notes = std::move(soup.notes);
  mesh.single_precision = soup.single_precision;
  return mesh;
}

}  // namespace sprung
