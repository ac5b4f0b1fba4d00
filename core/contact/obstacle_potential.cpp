#include "core/contact/obstacle_potential.h"

#include <algorithm>
#include <cmath>

#include "core/contact/broad_phase.h"

namespace sprung {
namespace {

constexpr double kStiffness = 20;       // times E h of the brick
constexpr double kPointsInContact = 4;  // of a brick, that share its stiffness: more are softer each

/// Pa, of a brick in its region; a brick cut by the surface is as stiff as a full one.
double young_at(const Body& body, int brick) {
  return body.material.young * std::max(1.0, body.stiffness_scale[brick]);
}

}  // namespace

std::vector<double> contact_stiffness(const SoftBody& body, const ContactSurface& skin) {
  std::vector<double> stiffness(skin.points.size());
  for (std::size_t i = 0; i < skin.bricks.size(); ++i) {
    const double count = skin.first_point[i + 1] - skin.first_point[i];
    const double whole = kStiffness * young_at(body, skin.bricks[i]) * body.grid.brick_size;
    for (int p = skin.first_point[i]; p < skin.first_point[i + 1]; ++p) {
      stiffness[p] = whole / std::max(1.0, count / kPointsInContact);
    }
  }
  return stiffness;
}

double pair_stiffness(double stiffness, const Body& body, int brick, const Body& other, int other_brick) {
  return stiffness * std::min(1.0, young_at(other, other_brick) / young_at(body, brick));
}

double glue_stiffness(const Body& body, int brick, const Body& other, int other_brick) {
  const double whole = kStiffness * young_at(body, brick) * body.grid.brick_size;
  return pair_stiffness(whole, body, brick, other, other_brick);
}

ObstaclePotential::ObstaclePotential(SoftBody& body, const Obstacle& obstacle, double slip_speed)
    : body_(body),
      obstacle_(obstacle),
      skin_(contact_surface_of(body)),
      slip_speed_(slip_speed),
      points_(skin_.points.size()),
      queries_(skin_.bricks.size()) {
  const std::vector<double> stiffness = contact_stiffness(body, skin_);
  for (std::size_t p = 0; p < points_.size(); ++p) points_[p].stiffness = stiffness[p];
}

/// Distances are queried again only if the brick may have come near since.
bool ObstaclePotential::is_far(std::size_t brick, const Points& positions) {
  AlignedBox box;
  for (const int node : body_.grid.nodes[skin_.bricks[brick]]) {
    box.extend(Vec3(positions.row(node)));
  }
  // Points lie in the hull of the corners, or a little outside where the surface has no brick of its own.
  const double reach = box.diagonal().norm();
  const Vec3 middle = pose_.rotation.transpose() * (box.center() - pose_.translation);
  GapQuery& query = queries_[brick];
  if (query.distance - (middle - query.position).norm() > reach) return true;
  query = {.position = middle, .distance = signed_distance(obstacle_.shape, {}, middle).distance};
  return query.distance > reach;
}

/// Calls visit(point, its brick and weights, position, gap) for the points that are inside the obstacle or were when
/// friction was last updated.
template <class Visit>
void ObstaclePotential::for_touching_points(const Points& positions, const Visit& visit) {
  for (std::size_t i = 0; i < skin_.bricks.size(); ++i) {
    const bool far = is_far(i, positions);
    const std::size_t last = skin_.first_point[i + 1];
    for (auto p = std::size_t(skin_.first_point[i]); p < last; ++p) {
      if (far && points_[p].normal_force == 0) continue;
      const Vec3 place = carried(body_, skin_.points[p], positions);
      const Gap gap = signed_distance(obstacle_.shape, pose_, place);
      if (gap.distance < 0 || points_[p].normal_force > 0) visit(points_[p], skin_.points[p], place, gap);
    }
  }
}

void ObstaclePotential::begin(const Points& positions, double elapsed, double dt) {
  slip_ = slip_speed_ * dt;
  const Pose before = pose_after(obstacle_, elapsed);
  pose_ = pose_after(obstacle_, elapsed + dt);
  const Mat3 turn = pose_.rotation * before.rotation.transpose();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Vec3 position = carried(body_, skin_.points[p], positions);
    points_[p].start = pose_.translation + turn * (position - before.translation);
  }
  update_friction(positions);
}

double ObstaclePotential::update_friction(const Points& positions) {
  double change = 0;
  for_touching_points(positions, [&](Point& point, const ContactPoint&, const Vec3&, const Gap& gap) {
    const double normal_force = point.stiffness * std::max(0.0, -gap.distance);
    change = std::max(change, std::abs(normal_force - point.normal_force));
    point.normal_force = normal_force;
    point.normal = gap.normal;
  });
  return obstacle_.friction > 0 ? change : 0;
}

double ObstaclePotential::largest_normal_force() const {
  double largest = 0;
  for (const Point& point : points_) largest = std::max(largest, point.normal_force);
  return largest;
}

FrictionPotential ObstaclePotential::friction_at(const Point& point, const Vec3& position) const {
  return {position - point.start, point.normal, obstacle_.friction * point.normal_force, slip_};
}

double ObstaclePotential::add_forces(const Points& positions, Points& forces) {
  double energy = 0;
  for_touching_points(positions, [&](Point& point, const ContactPoint& at, const Vec3& position, const Gap& gap) {
    const double depth = std::max(0.0, -gap.distance);
    const FrictionPotential friction = friction_at(point, position);
    energy += 0.5 * point.stiffness * depth * depth;
    energy += friction.energy();
    const Vec3 force = point.stiffness * depth * gap.normal + friction.force();
    const auto& nodes = body_.grid.nodes[at.brick];
    for (std::size_t c = 0; c < 8; ++c) forces.row(nodes[c]) += at.weights[c] * force.transpose();
  });
  return energy;
}

void ObstaclePotential::add_stiffness(const Points& positions, std::vector<PointStiffness>& points) {
  for_touching_points(positions, [&](Point& point, const ContactPoint& at, const Vec3& position, const Gap& gap) {
    Mat3 stiffness = friction_at(point, position).stiffness();
    if (gap.distance < 0) stiffness += point.stiffness * gap.normal * gap.normal.transpose();
    points.push_back({.brick = at.brick, .weights = at.weights, .stiffness = stiffness});
  });
}

}  // namespace sprung
