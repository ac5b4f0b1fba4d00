#include "core/world/obstacle.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Of a point off an axis or a middle; any direction will do at it.
Gap gap_to_round(const Vec3& off, double radius) {
  const double length = off.norm();
  return {length - radius, length > 0 ? Vec3(off / length) : Vec3(Vec3::UnitX())};
}

/// Of what has flat sides; `beyond` is how far the place lies beyond each, along the directions in `outward`.
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

Vec3 velocity_at(const Obstacle& obstacle, const Pose& pose, const Vec3& place) {
  return obstacle.velocity + obstacle.spin.cross(place - pose.translation);
}

Gap gap_to(const Shape& shape, const Pose& pose, const Vec3& place) {
  const Vec3 x = pose.rotation.transpose() * (place - pose.translation);
  Gap gap = std::visit([&](const auto& solid) { return gap_in_frame(solid, x); }, shape);
  gap.normal = pose.rotation * gap.normal;
  return gap;
}

}  // namespace sprung
