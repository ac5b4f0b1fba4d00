#include "core/world/mesh_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/mesh/nearest_triangle.h"

namespace sprung {
namespace {

constexpr double kOnSide = 1e-9;  // barycentric coordinates below lie on a side

/// Weights of a triangle's corners at a place of its plane.
Vec3 barycentric(const std::array<Vec3, 3>& x, const Vec3& place) {
  const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
  const double area = normal.squaredNorm();
  Vec3 weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = x[(i + 1) % 3];
    const Vec3& b = x[(i + 2) % 3];
    weights[static_cast<Eigen::Index>(i)] = (b - a).cross(place - a).dot(normal) / area;
  }
  return weights;
}

}  // namespace

class MeshDistance::Tree {
 public:
  Tree(const Points& positions, const Triangles& triangles)
      : positions_(positions),
        triangles_(triangles),
        surface_(positions, triangles),
        vertex_normals_(Points::Zero(positions.rows(), 3)),
        normals_(Points::Zero(triangles.rows(), 3)) {
    for (int row = 0; row < triangles.rows(); ++row) {
      const std::array<int, 3> corners = corners_of(row);
      const std::array<Vec3, 3> x = places(corners);
      const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
      if (!(normal.norm() > 0)) continue;
      normals_.row(row) = normal.normalized().transpose();
      for (std::size_t i = 0; i < 3; ++i) {
        const int from = corners[i];
        const int to = corners[(i + 1) % 3];
        const Vec3 ahead = x[(i + 1) % 3] - x[i];
        const Vec3 back = x[(i + 2) % 3] - x[i];
        const double angle = std::atan2(ahead.cross(back).norm(), ahead.dot(back));
        vertex_normals_.row(from) += angle * normals_.row(row);
        edge_normals_.try_emplace(std::minmax(from, to), Vec3::Zero()).first->second += normals_.row(row).transpose();
      }
    }
  }

  [[nodiscard]] Nearest nearest(const Vec3& place) const {
    const SurfacePlace found = surface_.at(place);
    const Vec3 outward = normal_at(found.triangle, found.point);
    const Vec3 off = place - found.point;
    const double distance = found.distance;
    const double sign = off.dot(outward) < 0 ? -1 : 1;
    // On the surface itself the direction to it says nothing.
    const bool is_off = distance > 1e-12 * (1 + found.point.norm());
    return {sign * distance, is_off ? Vec3(sign * off / distance) : outward.normalized()};
  }

 private:
  [[nodiscard]] std::array<int, 3> corners_of(int row) const {
    return {triangles_(row, 0), triangles_(row, 1), triangles_(row, 2)};
  }

  [[nodiscard]] std::array<Vec3, 3> places(const std::array<int, 3>& corners) const {
    return {positions_.row(corners[0]), positions_.row(corners[1]), positions_.row(corners[2])};
  }

  [[nodiscard]] Vec3 normal_at(int row, const Vec3& closest) const {
    const std::array<int, 3> corners = corners_of(row);
    const Vec3 weights = barycentric(places(corners), closest);
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[static_cast<Eigen::Index>(i)] > 1 - kOnSide) return vertex_normals_.row(corners[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[static_cast<Eigen::Index>(i)] > kOnSide) continue;
      return edge_normals_.at(std::minmax(corners[(i + 1) % 3], corners[(i + 2) % 3]));
    }
    return normals_.row(row);
  }

  Points positions_;
  Triangles triangles_;
  NearestTriangle surface_;
  Points vertex_normals_;                             // by angle, any length
  std::map<std::pair<int, int>, Vec3> edge_normals_;  // any length
  Points normals_;                                    // unit; 0 where there is no area
};

MeshDistance::MeshDistance(const Points& positions, const Triangles& triangles)
    : tree_(std::make_unique<Tree>(positions, triangles)) {}

MeshDistance::~MeshDistance() = default;

MeshDistance::Nearest MeshDistance::nearest(const Vec3& place) const { return tree_->nearest(place); }

}  // namespace sprung
