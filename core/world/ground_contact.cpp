#include "core/world/ground_contact.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kRecoverySteps = 20;  // a point found below the ground comes up within about that many steps
constexpr double kCornerFirst = 0.25;  // of points about as deep the one nearest to the corner holds the others best
constexpr double kLeastGravity = 0.1;  // m/s^2: without gravity too a point comes up

/// Upwards, that a point at `gap` over the ground must have at least, m/s.
double least_speed(double gap, double speed, const Ground& ground, double gravity, double dt) {
  const double depth = std::max(0.0, -gap);
  const double stop =
      gap >= 0 ? -gap / dt
               : std::min(depth / (kRecoverySteps * dt), std::sqrt(2 * std::max(gravity, kLeastGravity) * depth));
  return gap <= 0 && ground.restitution > 0 ? std::max(stop, -ground.restitution * speed) : stop;
}

}  // namespace

GroundContact::GroundContact(const Actor& actor) {
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
    const int place = next[static_cast<std::size_t>(brick_of_point[point])]++;
    Point& kept = points_[static_cast<std::size_t>(place)];
    kept.weights = trilinear_weights(actor.contacts.local.row(static_cast<Eigen::Index>(point)));
    kept.weights.maxCoeff(&kept.corner);
  }
}

const std::vector<Touch>& GroundContact::find(const Ground& ground, double gravity, double dt, const Body& body) {
  touches_.clear();
  for (const int brick : bricks_) {
    const auto b = static_cast<std::size_t>(brick);
    Eigen::Matrix<double, 8, 1> gaps;
    Eigen::Matrix<double, 8, 1> speeds;
    for (int corner = 0; corner < 8; ++corner) {
      const int node = body.grid.nodes[b][static_cast<std::size_t>(corner)];
      gaps[corner] = body.positions(node, 1) - ground.height;
      speeds[corner] = body.velocities(node, 1);
    }
    // Embedded points lie in the hull of the corners, or a little outside it where the surface has no brick.
    const double margin = 0.5 * (gaps.maxCoeff() - gaps.minCoeff());
    if ((gaps + dt * speeds).minCoeff() > margin) continue;
    std::array<Candidate, 8> worst{};
    for (int i = first_point_[b]; i < first_point_[b + 1]; ++i) {
      const Point& point = points_[static_cast<std::size_t>(i)];
      const double gap = point.weights.dot(gaps);
      const double speed = point.weights.dot(speeds);
      if (!(gap + dt * speed <= 0)) continue;  // nor where a number is not finite
      const double least = least_speed(gap, speed, ground, gravity, dt);
      const double pull = (least - speed) * (1 + kCornerFirst * point.weights[point.corner]);
      Candidate& candidate = worst[static_cast<std::size_t>(point.corner)];
      if (candidate.point == nullptr || pull > candidate.pull) candidate = {&point, pull, least};
    }
    for (const Candidate& candidate : worst) {
      if (candidate.point == nullptr) continue;
      touches_.push_back({.brick = brick,
                          .corner = static_cast<int>(candidate.point->corner),
                          .weights = candidate.point->weights,
                          .least_speed = candidate.least_speed});
    }
  }
  return touches_;
}

}  // namespace sprung
