#include "core/world/obstacle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/mesh/query/barycentric.h"
#include "core/mesh/query/closest_triangle.h"

namespace sprung {
namespace {

constexpr double kOnSide = 1e-9;  // barycentric coordinates below this are on a side

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

  [[nodiscard]] const Points& positions() const { return positions_; }
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }

  [[nodiscard]] Nearest nearest(const Vec3& position) const {
    const SurfaceProjection found = surface_.at(position);
    const Vec3 outward = normal_at(found.triangle, found.point);
    const Vec3 off = position - found.point;
    const double distance = found.distance;
    const double sign = off.dot(outward) < 0 ? -1 : 1;
    // On the surface itself the direction to it is undefined.
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
    const std::array<Vec3, 3> x = places(corners);
    const Vec3 weights = barycentric(x[1] - x[0], x[2] - x[0], closest - x[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[i] > 1 - kOnSide) return vertex_normals_.row(corners[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[i] > kOnSide) continue;
      return edge_normals_.at(std::minmax(corners[(i + 1) % 3], corners[(i + 2) % 3]));
    }
    return normals_.row(row);
  }

  Points positions_;
  Triangles triangles_;
  NearestTriangle surface_;
  Points vertex_normals_;                             // angle-weighted, any length
  std::map<std::pair<int, int>, Vec3> edge_normals_;  // any length
  Points normals_;                                    // unit; 0 if there is no area
};

MeshDistance::MeshDistance(const Points& positions, const Triangles& triangles)
    : tree_(std::make_unique<Tree>(positions, triangles)) {}

MeshDistance::~MeshDistance() = default;

MeshDistance::Nearest MeshDistance::nearest(const Vec3& position) const { return tree_->nearest(position); }

const Points& MeshDistance::positions() const { return tree_->positions(); }

const Triangles& MeshDistance::triangles() const { return tree_->triangles(); }

namespace {

/// Of a point at `off` from an axis or centre; on it any direction is right.
Gap gap_to_round(const Vec3& off, double radius) {
  const double length = off.norm();
  return {length - radius, length > 0 ? Vec3(off / length) : Vec3(Vec3::UnitX())};
}

/// Of a solid with flat sides; `beyond`: the distances of the point beyond each along the directions `outward`.
template <int N>
Gap gap_to_sides(const Eigen::Matrix<double, N, 1>& beyond, const Eigen::Matrix<double, 3, N>& outward) {
  Eigen::Index nearest = 0;
  const double most = beyond.maxCoeff(&nearest);
  if (most <= 0) return {most, outward.col(nearest)};
  const Vec3 off = outward * beyond.cwiseMax(0.0);
  const double distance = off.norm();
  return {distance, off / distance};
}

Gap gap_in_frame(const SolidHalfSpace& /*solid*/, const Vec3& x) { return {x.y(), Vec3::UnitY()}; }

Gap gap_in_frame(const SolidBox& box, const Vec3& x) {
  const Vec3 sign = x.unaryExpr([](double value) { return value < 0 ? -1.0 : 1.0; });
  return gap_to_sides<3>(x.cwiseAbs() - box.half, sign.asDiagonal().toDenseMatrix());
}

Gap gap_in_frame(const SolidBall& ball, const Vec3& x) { return gap_to_round(x, ball.radius); }

Gap gap_in_frame(const SolidCapsule& capsule, const Vec3& x) {
  const double along = std::clamp(x.y(), -capsule.half_length, capsule.half_length);
  return gap_to_round(x - along * Vec3::UnitY(), capsule.radius);
}

Gap gap_in_frame(const SolidCylinder& cylinder, const Vec3& x) {
  const Gap round = gap_to_round(Vec3(x.x(), 0, x.z()), cylinder.radius);
  Eigen::Matrix<double, 3, 2> outward;
  outward << round.normal, (x.y() < 0 ? -1.0 : 1.0) * Vec3::UnitY();
  return gap_to_sides<2>({round.distance, std::abs(x.y()) - cylinder.half_length}, outward);
}

Gap gap_in_frame(const MeshSolid& mesh, const Vec3& x) {
  const MeshDistance::Nearest nearest = mesh.distance->nearest(x);
  return {nearest.distance, nearest.normal};
}

}  // namespace

Obstacle level_ground(double height, double friction, double restitution) {
  Obstacle ground;
  ground.pose.translation.y() = height;
  ground.friction = friction;
  ground.restitution = restitution;
  return ground;
}

std::optional<double> ground_height(const Obstacle& obstacle) {
  if (!std::holds_alternative<SolidHalfSpace>(obstacle.shape) || obstacle.is_moving()) return std::nullopt;
  if (!obstacle.pose.rotation.col(1).isApprox(Vec3::UnitY())) return std::nullopt;
  return obstacle.pose.translation.y();
}

const Obstacle* highest_ground(const std::vector<Obstacle>& obstacles) {
  const Obstacle* highest = nullptr;
  for (const Obstacle& obstacle : obstacles) {
    const std::optional<double> height = ground_height(obstacle);
    if (height && (highest == nullptr || *height > *ground_height(*highest))) highest = &obstacle;
  }
  return highest;
}

std::optional<double> ground_height(const std::vector<Obstacle>& obstacles) {
  const Obstacle* highest = highest_ground(obstacles);
  return highest == nullptr ? std::nullopt : ground_height(*highest);
}

Pose pose_after(const Obstacle& obstacle, double time) {
  Pose pose = obstacle.pose;
  pose.translation += time * obstacle.velocity;
  const double turn = time * obstacle.spin.norm();
  if (turn != 0) {
    pose.rotation = Eigen::AngleAxisd(turn, obstacle.spin.normalized()) * pose.rotation;
  }
  return pose;
}

void move_obstacles(std::vector<Obstacle>& obstacles, double time) {
  for (Obstacle& obstacle : obstacles) obstacle.pose = pose_after(obstacle, time);
}

Vec3 velocity_at(const Obstacle& obstacle, const Pose& pose, const Vec3& position) {
  return obstacle.velocity + obstacle.spin.cross(position - pose.translation);
}

Gap signed_distance(const Shape& shape, const Pose& pose, const Vec3& position) {
  const Vec3 x = pose.rotation.transpose() * (position - pose.translation);
  Gap gap = std::visit([&](const auto& solid) { return gap_in_frame(solid, x); }, shape);
  gap.normal = pose.rotation * gap.normal;
  return gap;
}

}  // namespace sprung
