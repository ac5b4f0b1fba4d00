#include "core/skin/corner_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace sprung {
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
  split.source.resize(static_cast<std::size_t>(mesh.positions.rows()));
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
    ++lists.first[static_cast<std::size_t>(point_of[static_cast<std::size_t>(triangles.data()[i])]) + 1];
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  lists.corners.resize(static_cast<std::size_t>(triangles.size()));
  for (int i = 0; i < triangles.size(); ++i) {
    const auto point = static_cast<std::size_t>(point_of[static_cast<std::size_t>(triangles.data()[i])]);
    lists.corners[static_cast<std::size_t>(next[point]++)] = i;
  }
  return lists;
}

/// Makes the split vertices around one point after another.
class CreaseSplitter {
 public:
  CreaseSplitter(const SurfaceMesh& mesh, const Points& faces, double crease_angle)
      : mesh_(mesh), faces_(faces), smooth_cosine_(std::cos(crease_angle * std::numbers::pi / 180)) {
    split_.triangles = mesh.triangles;
  }

  void split_point(const int* begin, const int* end) {
    std::vector<int> group(static_cast<std::size_t>(end - begin));
    std::iota(group.begin(), group.end(), 0);
    join_smooth_neighbours(begin, group);
    std::map<int, Vec3> normal_of_group;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Vec3 face = unit_or(faces_.row(begin[i] / 3), Vec3::Zero());
      normal_of_group.try_emplace(root(group, static_cast<int>(i)), Vec3::Zero()).first->second +=
          corner_angle(mesh_, begin[i] / 3, begin[i] % 3) * face;
    }
    std::map<std::pair<int, int>, int> made;  // (mesh vertex, group) to split vertex
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int vertex = mesh_.triangles.data()[begin[i]];
      const int of = root(group, static_cast<int>(i));
      const auto [entry, is_new] = made.try_emplace({vertex, of}, static_cast<int>(split_.source.size()));
      if (is_new) {
        split_.source.push_back(vertex);
        normals_.push_back(unit_or(normal_of_group.at(of), Vec3::UnitY()));
      }
      split_.triangles.data()[begin[i]] = entry->second;
    }
  }

  SplitVertices finish() {
    split_.normals.resize(static_cast<int>(normals_.size()), 3);
    for (std::size_t i = 0; i < normals_.size(); ++i) split_.normals.row(static_cast<int>(i)) = normals_[i];
    return std::move(split_);
  }

 private:
  static int root(std::vector<int>& group, int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  }

  /// Two triangles at the point that share an edge there and meet smoothly belong together.
  void join_smooth_neighbours(const int* corners, std::vector<int>& group) {
    for (std::size_t a = 0; a < group.size(); ++a) {
      for (std::size_t b = a + 1; b < group.size(); ++b) {
        if (!share_edge(corners[a], corners[b]) || !is_smooth(corners[a] / 3, corners[b] / 3)) continue;
        const int low = root(group, static_cast<int>(a));
        const int high = root(group, static_cast<int>(b));
        group[static_cast<std::size_t>(std::max(low, high))] = std::min(low, high);
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

std::vector<int> weld_points(const Points& positions) {
  const auto before = [&](int a, int b) {
    for (int k = 0; k < 3; ++k) {
      if (positions(a, k) != positions(b, k)) return positions(a, k) < positions(b, k);
    }
    return a < b;
  };
  std::vector<int> order(static_cast<std::size_t>(positions.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), before);
  std::vector<int> point_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions.row(order[i]) == positions.row(order[i - 1]);
    point_of[static_cast<std::size_t>(order[i])] = same ? point_of[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return point_of;
}

SplitVertices split_at_creases(const SurfaceMesh& mesh, double crease_angle) {
  const Points faces = face_vectors(mesh);
  if (mesh.normals.rows() == mesh.positions.rows() && mesh.normals.rows() > 0) return keep_normals(mesh, faces);
  const CornerLists lists = list_corners(mesh.triangles, weld_points(mesh.positions));
  CreaseSplitter splitter(mesh, faces, crease_angle);
  for (std::size_t point = 0; point + 1 < lists.first.size(); ++point) {
    if (lists.first[point] == lists.first[point + 1]) continue;
    splitter.split_point(&lists.corners[static_cast<std::size_t>(lists.first[point])],
                         lists.corners.data() + lists.first[point + 1]);
  }
  return splitter.finish();
}

}  // namespace sprung
