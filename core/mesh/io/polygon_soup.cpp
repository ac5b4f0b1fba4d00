#include "core/mesh/io/polygon_soup.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <limits>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

using Plane2 = Eigen::Vector2d;

/// Twice the signed area of a triangle.
double cross(const Plane2& a, const Plane2& b, const Plane2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The polygon seen along its area vector (Newell), so that it winds counter-clockwise.
std::vector<Plane2> flatten(const Points& points, std::span<const int> polygon) {
  const Vec3 origin = points.row(polygon[0]);
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 a = points.row(polygon[i]).transpose() - origin;
    const Vec3 b = points.row(polygon[i + 1]).transpose() - origin;
    normal += a.cross(b);
  }
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.normalized().cross(u);
  std::vector<Plane2> flat;
  for (const int corner : polygon) {
    const Vec3 p = points.row(corner).transpose() - origin;
    flat.emplace_back(p.dot(u), p.dot(v));
  }
  return flat;
}

bool is_convex(const std::vector<Plane2>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
  }
  return true;
}

/// The rest of a polygon during ear clipping, by indices into the polygon.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Plane2>& flat) : flat_(flat) {
    for (std::size_t i = 0; i < flat.size(); ++i) left_.push_back(i);
  }
  [[nodiscard]] std::size_t size() const { return left_.size(); }

  /// Where no corner is an ear (in a self-intersecting polygon), the most convex one is cut, so that clipping ends.
  /// Large self-intersecting polygons would take hours: after a limit the rest becomes a fan.
  std::array<std::size_t, 3> cut() {
    std::size_t best = left_.size() - 1;
    double best_area = -1e300;
    for (std::size_t i = 0; i < left_.size() && tests_ < kMaxTests; ++i) {
      const auto [a, b, c] = corner(i);
      const double area = cross(flat_[a], flat_[b], flat_[c]);
      if (area > 0 && is_empty(i)) {
        best = i;
        break;
      }
      if (area > best_area) {
        best = i;
        best_area = area;
      }
    }
    const auto ear = corner(best);
    left_.erase(left_.begin() + std::ptrdiff_t(best));
    return ear;
  }

 private:
  [[nodiscard]] std::array<std::size_t, 3> corner(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }

  [[nodiscard]] bool is_empty(std::size_t i) {
    const auto [a, b, c] = corner(i);
    for (const std::size_t p : left_) {
      ++tests_;
      if (p == a || p == b || p == c) continue;
      if (cross(flat_[a], flat_[b], flat_[p]) >= 0 && cross(flat_[b], flat_[c], flat_[p]) >= 0 &&
          cross(flat_[c], flat_[a], flat_[p]) >= 0) {
        return false;
      }
    }
    return true;
  }

  static constexpr long kMaxTests = 100'000'000;  // half a second

  const std::vector<Plane2>& flat_;
  std::vector<std::size_t> left_;
  long tests_ = 0;
};

}  // namespace

void cut_polygon(const Points& points, std::span<const int> polygon, std::vector<std::array<int, 3>>& triangles) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  if (polygon.size() == 3) return add(0, 1, 2);
  const std::vector<Plane2> flat = flatten(points, polygon);
  if (is_convex(flat)) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) add(0, i, i + 1);
    return;
  }
  EarClipper clipper(flat);
  while (clipper.size() >= 3) {
    const auto [a, b, c] = clipper.cut();
    add(a, b, c);
  }
}

namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, reason));
}

/// The vertices of a mesh: one for each distinct combination of position, UV and normal.
class Vertices {
 public:
  explicit Vertices(std::size_t positions) : first_(positions, -1) {}

  /// The index of the corner's vertex, equal for equal corners.
  int find_or_add(const Corner& corner) {
    int& first = first_[corner.position];
    for (int i = first; i >= 0; i = next_[i]) {
      const Corner& known = corners_[i];
      if (known.uv == corner.uv && known.normal == corner.normal) return i;
    }
    next_.push_back(first);
    corners_.push_back(corner);
    return first = isize(corners_) - 1;
  }

  /// Unused positions become vertices, too.
  void add_unused() {
    for (std::size_t p = 0; p < first_.size(); ++p) {
      if (first_[p] < 0) static_cast<void>(find_or_add({int(p)}));
    }
  }

  /// Renumbers the vertices in the order of their positions in the file; returns the new rows by the old ones.
  std::vector<int> rows() const {
    std::vector<int> rows(corners_.size());
    int row = 0;
    for (const int first : first_) {
      for (int i = first; i >= 0; i = next_[i]) rows[i] = row++;
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
  if (rows.rows() > 0 && index >= 0) rows.row(row) = list[index];
}

void fill_vertices(const PolygonSoup& soup, const Vertices& vertices, const std::vector<int>& rows, SurfaceMesh& mesh) {
  const auto count = isize(rows);
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

/// The triangles of each part, with corners as rows of the mesh.
std::vector<std::vector<std::array<int, 3>>> cut(const PolygonSoup& soup, const Points& positions,
                                                 const std::vector<int>& corner_rows) {
  std::vector<std::vector<std::array<int, 3>>> triangles(soup.parts.size());
  std::span<const int> left(corner_rows);
  for (std::size_t p = 0; p < soup.corner_counts.size(); ++p) {
    const std::size_t count = soup.corner_counts[p];
    cut_polygon(positions, left.first(count), triangles[soup.polygon_parts[p]]);
    left = left.subspan(count);
  }
  return triangles;
}

void fill_triangles(const std::vector<std::vector<std::array<int, 3>>>& triangles, std::vector<Part> parts,
                    SurfaceMesh& mesh) {
  std::size_t count = 0;
  for (const auto& of_part : triangles) count += of_part.size();
  mesh.triangles.resize(count, 3);
  int row = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (triangles[p].empty()) continue;
    parts[p].first_triangle = row;
    parts[p].triangle_count = isize(triangles[p]);
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
  const std::string contents = count_of(points, "point");
  if (lines == 0) return fmt::format("no faces (a point cloud); it holds {}", contents);
  return fmt::format("no faces (lines only); it holds {} and {}", contents, count_of(lines, "line"));
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
  for (int& vertex : corner_rows) vertex = rows[vertex];

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
