#include "core/world/ground_contact.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr int kSweeps = 4;
constexpr double kRecoverySteps = 20;  // a point found below the ground comes up within about that many steps

Vec3 point_velocity(const Body& body, int brick, const Eigen::Matrix<double, 8, 1>& weights) {
  Vec3 velocity = Vec3::Zero();
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(brick)];
  for (int corner = 0; corner < 8; ++corner) {
    velocity += weights[corner] * body.velocities.row(nodes[static_cast<std::size_t>(corner)]).transpose();
  }
  return velocity;
}

}  // namespace

GroundContact::GroundContact(const Actor& actor, Eigen::VectorXd inverse_masses)
    : inverse_masses_(std::move(inverse_masses)) {
  const auto bricks = static_cast<std::size_t>(actor.body.grid.brick_count());
  const std::vector<int>& brick_of_point = actor.contacts.brick;
  first_point_.assign(bricks + 1, 0);
  for (const int brick : brick_of_point) ++first_point_[static_cast<std::size_t>(brick) + 1];
  for (std::size_t i = 0; i < bricks; ++i) {
    if (first_point_[i + 1] > 0) bricks_.push_back(static_cast<int>(i));
    first_point_[i + 1] += first_point_[i];
  }
  std::vector<int> next(first_point_.begin(), first_point_.end() - 1);
  points_.resize(brick_of_point.size());
  for (std::size_t point = 0; point < brick_of_point.size(); ++point) {
    points_[static_cast<std::size_t>(next[static_cast<std::size_t>(brick_of_point[point])]++)] =
        static_cast<int>(point);
  }
}

void GroundContact::find_touches(const Ground& ground, double dt, const Actor& actor) {
  const Body& body = actor.body;
  touches_.clear();
  for (const int brick : bricks_) {
    const auto b = static_cast<std::size_t>(brick);
    Eigen::Matrix<double, 8, 1> gaps;
    Eigen::Matrix<double, 8, 1> speeds;
    Eigen::Matrix<double, 8, 1> inverse_masses;
    for (int corner = 0; corner < 8; ++corner) {
      const int node = body.grid.nodes[b][static_cast<std::size_t>(corner)];
      gaps[corner] = body.positions(node, 1) - ground.height;
      speeds[corner] = body.velocities(node, 1);
      inverse_masses[corner] = inverse_masses_[node];
    }
    // Embedded points lie in the hull of the corners, or a little outside it where the surface has no brick.
    const double margin = 0.5 * (gaps.maxCoeff() - gaps.minCoeff());
    if ((gaps + dt * speeds).minCoeff() > margin) continue;
    for (int i = first_point_[b]; i < first_point_[b + 1]; ++i) {
      const int point = points_[static_cast<std::size_t>(i)];
      const Eigen::Matrix<double, 8, 1> weights = trilinear_weights(actor.contacts.local.row(point));
      const double gap = weights.dot(gaps);
      const double speed = weights.dot(speeds);
      if (gap + dt * speed > 0) continue;
      const double inverse_mass = weights.cwiseAbs2().dot(inverse_masses);
      if (inverse_mass <= 0) continue;
      const double stop = gap >= 0 ? -gap / dt : -gap / (kRecoverySteps * dt);
      const double bounce = gap <= 0 ? -ground.restitution * speed : stop;
      touches_.push_back({.brick = brick,
                          .weights = weights,
                          .inverse_mass = inverse_mass,
                          .least_speed = std::max(stop, ground.restitution > 0 ? bounce : stop)});
    }
  }
}

void GroundContact::solve(const Ground& ground, Touch& touch, Actor& actor) const {
  Body& body = actor.body;
  const Vec3 velocity = point_velocity(body, touch.brick, touch.weights);
  const double normal = std::max(0.0, touch.normal + (touch.least_speed - velocity.y()) / touch.inverse_mass);
  Eigen::Vector2d tangential = touch.tangential - Eigen::Vector2d(velocity.x(), velocity.z()) / touch.inverse_mass;
  const double most = ground.friction * normal;
  if (tangential.norm() > most) tangential *= most / tangential.norm();
  const Vec3 impulse(tangential.x() - touch.tangential.x(), normal - touch.normal,
                     tangential.y() - touch.tangential.y());
  touch.normal = normal;
  touch.tangential = tangential;
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(touch.brick)];
  for (int corner = 0; corner < 8; ++corner) {
    const int node = nodes[static_cast<std::size_t>(corner)];
    body.velocities.row(node) += touch.weights[corner] * inverse_masses_[node] * impulse.transpose();
  }
}

void GroundContact::apply(const Ground& ground, double dt, Actor& actor) {
  find_touches(ground, dt, actor);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Touch& touch : touches_) solve(ground, touch, actor);
  }
}

}  // namespace sprung
