#include "core/skin/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/mesh/repair/weld.h"

namespace sprung {
namespace {

template <class Rows>
Rows rows_of(const Rows& all, const std::vector<int>& rows) {
  if (all.rows() == 0) return {};
  return all(rows, Eigen::all);
}

}  // namespace

Skin make_skin(const SurfaceMesh& mesh, const SkinOptions& options) {
  const SplitVertices split = split_at_creases(mesh, options.crease_angle, options.is_smooth);
  Skin skin;
  skin.positions = rows_of(mesh.positions, split.source);
  skin.normals = split.normals;
  skin.uvs = rows_of(mesh.uvs, split.source);
  skin.colors = rows_of(mesh.colors, split.source);
  skin.triangles = split.triangles;
  skin.parts = mesh.parts;
  skin.materials = mesh.materials;
  if (options.max_edge > 0) refine(skin, options.max_edge);
  return skin;
}

namespace {

constexpr double kTiny = 1e-300;

Vec3 vertex_position(const SurfaceMesh& mesh, int triangle, int corner) {
  return mesh.positions.row(mesh.triangles(triangle, corner % 3));
}

/// Twice the area vector of each triangle.
Points face_vectors(const SurfaceMesh& mesh) {
  Points vectors(mesh.triangles.rows(), 3);
  for (int t = 0; t < vectors.rows(); ++t) {
    const Vec3 a = vertex_position(mesh, t, 0);
    vectors.row(t) = (vertex_position(mesh, t, 1) - a).cross(vertex_position(mesh, t, 2) - a);
  }
  return vectors;
}

double corner_angle(const SurfaceMesh& mesh, int triangle, int corner) {
  const Vec3 at = vertex_position(mesh, triangle, corner);
  const Vec3 a = vertex_position(mesh, triangle, corner + 1) - at;
  const Vec3 b = vertex_position(mesh, triangle, corner + 2) - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 unit_or(const Vec3& vector, const Vec3& fallback) {
  const double length = vector.norm();
  return length > kTiny ? Vec3(vector / length) : fallback;
}

SplitVertices keep_normals(const SurfaceMesh& mesh, const Points& faces) {
  Points around = Points::Zero(mesh.positions.rows(), 3);
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) around.row(mesh.triangles(t, c)) += faces.row(t);
  }
  SplitVertices split;
  split.source.resize(mesh.positions.rows());
  std::iota(split.source.begin(), split.source.end(), 0);
  split.triangles = mesh.triangles;
  split.normals.resize(mesh.positions.rows(), 3);
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const Vec3 face = unit_or(around.row(v), Vec3::UnitY());
    const Vec3 given = unit_or(mesh.normals.row(v).cast<double>(), face);
    split.normals.row(v) = given.dot(face) < 0 ? -given : given;
  }
  return split;
}

/// The corners that meet at each point: 3 triangle + corner, grouped by point.
struct CornerLists {
  std::vector<int> corners;
  std::vector<int> first;
};

CornerLists list_corners(const Triangles& triangles, const std::vector<int>& point_of) {
  CornerLists lists;
  lists.first.assign(point_of.size() + 1, 0);
  for (int i = 0; i < triangles.size(); ++i) {
    ++lists.first[point_of[triangles.data()[i]] + 1];
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  lists.corners.resize(triangles.size());
  for (int i = 0; i < triangles.size(); ++i) {
    const std::size_t point = point_of[triangles.data()[i]];
    lists.corners[next[point]++] = i;
  }
  return lists;
}

double cosine_of_degrees(double angle) { return std::cos(angle * std::numbers::pi / 180); }

/// Triangles in one plane, joined by edges.
struct FlatFace {
  double area = 0;  // twice, m^2
  int triangles = 0;
};

/// That of each triangle.
std::vector<FlatFace> flat_faces(const Triangles& triangles, const Points& faces, const std::vector<int>& point_of) {
  constexpr double kSameWay = 0.0017;  // sine of 0.1 degrees
  DisjointSets planes(triangles.rows());
  std::map<std::pair<int, int>, int> triangle_of_edge;
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax({point_of[triangles(t, c)], point_of[triangles(t, (c + 1) % 3)]});
      const auto [entry, is_new] = triangle_of_edge.try_emplace({low, high}, t);
      if (is_new) continue;
      const Vec3 a = faces.row(t);
      const Vec3 b = faces.row(entry->second);
      if (a.dot(b) > 0 && a.cross(b).norm() < kSameWay * a.norm() * b.norm()) planes.merge(t, entry->second);
    }
  }
  std::vector<FlatFace> all(triangles.rows());
  for (int t = 0; t < triangles.rows(); ++t) {
    FlatFace& face = all[planes.find(t)];
    face.area += faces.row(t).norm();
    ++face.triangles;
  }
  for (int t = 0; t < triangles.rows(); ++t) all[t] = all[planes.find(t)];
  return all;
}

/// True if a mesh was saved with flat shading: all its normals are those of its triangles.
bool has_normals_of_triangles(const SurfaceMesh& mesh, const Points& faces) {
  constexpr double kSame = 0.9995;  // 1.8 degrees: some files have few digits
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const Vec3 face = faces.row(t);
    for (int c = 0; c < 3; ++c) {
      const Vec3 normal = mesh.normals.row(mesh.triangles(t, c)).cast<double>();
      if (std::abs(normal.dot(face)) < kSame * normal.norm() * face.norm()) return false;
    }
  }
  return true;
}

/// Splits the vertices at one point after another.
class CreaseSplitter {
 public:
  /// `flat`: by triangle; none: they count as the others do.
  CreaseSplitter(const SurfaceMesh& mesh, const Points& faces, double crease_angle, std::vector<FlatFace> flat)
      : mesh_(mesh), faces_(faces), smooth_cosine_(cosine_of_degrees(crease_angle)), flat_(std::move(flat)) {
    split_.triangles = mesh.triangles;
  }

  void split_point(const int* begin, const int* end) {
    DisjointSets groups(end - begin);
    join_smooth_neighbours(begin, groups);
    std::map<int, Vec3> normal_of_group;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Vec3 face = unit_or(faces_.row(begin[i] / 3), Vec3::Zero());
      normal_of_group.try_emplace(groups.find(int(i)), Vec3::Zero()).first->second +=
          corner_angle(mesh_, begin[i] / 3, begin[i] % 3) * flat_face(begin[i] / 3).area * face;
    }
    std::map<std::pair<int, int>, int> made;  // (mesh vertex, group) to split vertex
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const int vertex = mesh_.triangles.data()[begin[i]];
      const int group = groups.find(int(i));
      const auto [entry, is_new] = made.try_emplace({vertex, group}, isize(split_.source));
      if (is_new) {
        split_.source.push_back(vertex);
        normals_.push_back(unit_or(normal_of_group.at(group), Vec3::UnitY()));
      }
      split_.triangles.data()[begin[i]] = entry->second;
    }
  }

  SplitVertices finish() {
    split_.normals.resize(isize(normals_), 3);
    for (std::size_t i = 0; i < normals_.size(); ++i) split_.normals.row(i) = normals_[i];
    return std::move(split_);
  }

 private:
  /// Joins triangles that share an edge at the point and meet smoothly.
  void join_smooth_neighbours(const int* corners, DisjointSets& groups) {
    for (std::size_t a = 0; a < groups.size(); ++a) {
      for (std::size_t b = a + 1; b < groups.size(); ++b) {
        if (share_edge(corners[a], corners[b]) && is_smooth(corners[a] / 3, corners[b] / 3))
          groups.merge(int(a), int(b));
      }
    }
  }

  [[nodiscard]] bool share_edge(int corner_a, int corner_b) const {
    const Vec3 a_next = vertex_position(mesh_, corner_a / 3, corner_a % 3 + 1);
    const Vec3 a_last = vertex_position(mesh_, corner_a / 3, corner_a % 3 + 2);
    const Vec3 b_next = vertex_position(mesh_, corner_b / 3, corner_b % 3 + 1);
    const Vec3 b_last = vertex_position(mesh_, corner_b / 3, corner_b % 3 + 2);
    return a_next == b_last || a_last == b_next;
  }

  [[nodiscard]] bool is_smooth(int triangle_a, int triangle_b) const {
    const bool is_at_flat_face = std::max(flat_face(triangle_a).triangles, flat_face(triangle_b).triangles) > 1;
    const double least = is_at_flat_face ? std::max(smooth_cosine_, cosine_of_degrees(35)) : smooth_cosine_;
    const double scale = faces_.row(triangle_a).norm() * faces_.row(triangle_b).norm();
    return scale < kTiny || faces_.row(triangle_a).dot(faces_.row(triangle_b)) >= least * scale;
  }

  [[nodiscard]] FlatFace flat_face(int triangle) const {
    return flat_.empty() ? FlatFace{.area = 1, .triangles = 1} : flat_[triangle];
  }

  const SurfaceMesh& mesh_;
  const Points& faces_;
  double smooth_cosine_;
  std::vector<FlatFace> flat_;
  SplitVertices split_;
  std::vector<Vec3> normals_;
};

}  // namespace

SplitVertices split_at_creases(const SurfaceMesh& mesh, double crease_angle, bool is_smooth) {
  const Points faces = face_vectors(mesh);
  const bool has_normals = mesh.normals.rows() == mesh.positions.rows() && mesh.normals.rows() > 0;
  if (has_normals && !(is_smooth && has_normals_of_triangles(mesh, faces))) return keep_normals(mesh, faces);
  const std::vector<int> point_of = weld_points(mesh.positions);
  const CornerLists lists = list_corners(mesh.triangles, point_of);
  CreaseSplitter splitter(mesh, faces, crease_angle,
                          is_smooth ? flat_faces(mesh.triangles, faces, point_of) : std::vector<FlatFace>());
  for (std::size_t point = 0; point + 1 < lists.first.size(); ++point) {
    if (lists.first[point] == lists.first[point + 1]) continue;
    splitter.split_point(&lists.corners[lists.first[point]], lists.corners.data() + lists.first[point + 1]);
  }
  return splitter.finish();
}

}  // namespace sprung
