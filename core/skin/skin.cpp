#include "core/skin/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>
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
  const SplitVertices split = split_at_creases(mesh, options.crease_angle);
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

/// Splits the vertices at one point after another.
class CreaseSplitter {
 public:
  CreaseSplitter(const SurfaceMesh& mesh, const Points& faces, double crease_angle)
      : mesh_(mesh), faces_(faces), smooth_cosine_(std::cos(crease_angle * std::numbers::pi / 180)) {
    split_.triangles = mesh.triangles;
  }

  void split_point(const int* begin, const int* end) {
    DisjointSets groups(end - begin);
    join_smooth_neighbours(begin, groups);
    std::map<int, Vec3> normal_of_group;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Vec3 face = unit_or(faces_.row(begin[i] / 3), Vec3::Zero());
      normal_of_group.try_emplace(groups.find(int(i)), Vec3::Zero()).first->second +=
          corner_angle(mesh_, begin[i] / 3, begin[i] % 3) * face;
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
    const double scale = faces_.row(triangle_a).norm() * faces_.row(triangle_b).norm();
    return scale < kTiny || faces_.row(triangle_a).dot(faces_.row(triangle_b)) >= smooth_cosine_ * scale;
  }

  const SurfaceMesh& mesh_;
  const Points& faces_;
  double smooth_cosine_;
  SplitVertices split_;
  std::vector<Vec3> normals_;
};

}  // namespace

SplitVertices split_at_creases(const SurfaceMesh& mesh, double crease_angle) {
  const Points faces = face_vectors(mesh);
  if (mesh.normals.rows() == mesh.positions.rows() && mesh.normals.rows() > 0) return keep_normals(mesh, faces);
  const CornerLists lists = list_corners(mesh.triangles, weld_points(mesh.positions));
  CreaseSplitter splitter(mesh, faces, crease_angle);
  for (std::size_t point = 0; point + 1 < lists.first.size(); ++point) {
    if (lists.first[point] == lists.first[point + 1]) continue;
    splitter.split_point(&lists.corners[lists.first[point]], lists.corners.data() + lists.first[point + 1]);
  }
  return splitter.finish();
}

namespace {

/// One pass: every long edge of the skin is halved once.
class Refiner {
 public:
  Refiner(const Skin& skin, double max_edge) : skin_(skin), max_squared_(max_edge * max_edge) {}

  /// False where no edge was too long.
  bool run(Skin& refined) {
    for (const Part& part : skin_.parts) {
      const auto first = isize(triangles_);
      for (int t = 0; t < part.triangle_count; ++t) split_triangle(part.first_triangle + t);
      refined.parts.push_back(part);
      refined.parts.back().first_triangle = first;
      refined.parts.back().triangle_count = isize(triangles_) - first;
    }
    if (ends_.empty()) return false;
    refined.materials = skin_.materials;
    refined.positions = with_midpoints(skin_.positions);
    refined.normals = with_midpoints(skin_.normals);
    refined.normals.bottomRows(isize(ends_)).rowwise().normalize();
    if (skin_.uvs.rows() > 0) refined.uvs = with_midpoints(skin_.uvs);
    if (skin_.colors.rows() > 0) refined.colors = with_midpoints(skin_.colors);
    refined.triangles.resize(isize(triangles_), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (int c = 0; c < 3; ++c) refined.triangles(t, c) = triangles_[t][c];
    }
    return true;
  }

 private:
  template <class Rows>
  [[nodiscard]] Rows with_midpoints(const Rows& rows) const {
    Rows all(rows.rows() + isize(ends_), rows.cols());
    all.topRows(rows.rows()) = rows;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      all.row(rows.rows() + int(i)) = (rows.row(ends_[i][0]) + rows.row(ends_[i][1])) / 2;
    }
    return all;
  }

  /// The middle vertex of an edge, or -1 where the edge is short enough.
  int middle(int a, int b) {
    if ((skin_.positions.row(a) - skin_.positions.row(b)).squaredNorm() <= max_squared_) return -1;
    if (a > b) std::swap(a, b);
    const std::uint64_t key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const int next = int(skin_.positions.rows()) + isize(ends_);
    const auto [entry, is_new] = middles_.try_emplace(key, next);
    if (is_new) ends_.push_back({a, b});
    return entry->second;
  }

  void split_triangle(int triangle) {
    std::array<int, 3> v{};
    std::array<int, 3> m{};  // m[i]: middle of the edge from v[i] to v[i + 1]
    for (std::size_t i = 0; i < 3; ++i) v[i] = skin_.triangles(triangle, i);
    std::size_t halved = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i] = middle(v[i], v[(i + 1) % 3]);
      halved += m[i] >= 0 ? 1 : 0;
    }
    if (halved == 0) {
      triangles_.push_back(v);
      return;
    }
    if (halved == 3) {
      for (std::size_t i = 0; i < 3; ++i) triangles_.push_back({v[i], m[i], m[(i + 2) % 3]});
      triangles_.push_back(m);
      return;
    }
    split_partly(v, m, halved);
  }

  void split_partly(std::array<int, 3> v, std::array<int, 3> m, std::size_t halved) {
    // Turn the triangle until edge 0 is halved and, of two halved edges, the other one is edge 1.
    while (m[0] < 0 || (halved == 2 && m[1] < 0)) {
      v = {v[1], v[2], v[0]};
      m = {m[1], m[2], m[0]};
    }
    if (halved == 1) {
      triangles_.push_back({v[0], m[0], v[2]});
      triangles_.push_back({m[0], v[1], v[2]});
      return;
    }
    triangles_.push_back({m[0], v[1], m[1]});
    triangles_.push_back({v[0], m[0], m[1]});
    triangles_.push_back({v[0], m[1], v[2]});
  }

  const Skin& skin_;
  double max_squared_;
  std::unordered_map<std::uint64_t, int> middles_;
  std::vector<std::array<int, 2>> ends_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

void refine(Skin& skin, double max_edge) {
  for (bool again = true; again;) {
    Skin refined;
    again = Refiner(skin, max_edge).run(refined);
    if (again) skin = std::move(refined);
  }
}

}  // namespace sprung
