#include "core/motion/ground_potential.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kHardness = 20;        // times E h of the brick
constexpr double kPointsInContact = 4;  // of a brick, that share its hardness: more are softer each

}  // namespace

GroundPotential::GroundPotential(const Actor& actor, double height, double friction, double slip_speed)
    : actor_(actor), height_(height), friction_(friction), slip_speed_(slip_speed) {
  ContactSkin skin(actor);
  bricks_ = std::move(skin.bricks);
  first_ = std::move(skin.first_point);
  const Body& body = actor.body;
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    const double count = first_[i + 1] - first_[i];
    const double scale = std::max(1.0, body.stiffness_scale[static_cast<std::size_t>(bricks_[i])]);
    const double stiffness = kHardness * body.material.young * body.grid.brick_size * scale;
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      points_.push_back({.contact = skin.points[static_cast<std::size_t>(p)],
                         .stiffness = stiffness / std::max(1.0, count / kPointsInContact)});
    }
  }
}

/// Calls visit(index, place, depth) for the points that are below the ground or were when friction was last updated.
template <class Visit>
void GroundPotential::for_low_points(const Points& positions, const Visit& visit) const {
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    const auto& nodes = actor_.body.grid.nodes[static_cast<std::size_t>(bricks_[i])];
    double low = positions(nodes[0], 1);
    double high = low;
    for (const int node : nodes) {
      low = std::min(low, positions(node, 1));
      high = std::max(high, positions(node, 1));
    }
    // Points lie in the hull of the corners, or a little outside where the surface has no brick of its own.
    const bool is_far = low - 0.5 * (high - low) > height_;
    for (auto p = static_cast<std::size_t>(first_[i]); p < static_cast<std::size_t>(first_[i + 1]); ++p) {
      if (is_far && points_[p].normal == 0) continue;
      const Vec3 at = carried(actor_.body, points_[p].contact, positions);
      const double depth = std::max(0.0, height_ - at.y());
      if (depth > 0 || points_[p].normal > 0) visit(p, at, depth);
    }
  }
}

void GroundPotential::begin(const Points& positions, double dt) {
  slip_ = slip_speed_ * dt;
  for (Point& point : points_) point.start = carried(actor_.body, point.contact, positions);
  update_friction(positions);
}

double GroundPotential::update_friction(const Points& positions) {
  std::vector<double> normals(points_.size(), 0);
  for_low_points(positions,
                 [&](std::size_t p, const Vec3&, double depth) { normals[p] = points_[p].stiffness * depth; });
  double change = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    change = std::max(change, std::abs(normals[p] - points_[p].normal));
    points_[p].normal = normals[p];
  }
  return friction_ > 0 ? change : 0;
}

double GroundPotential::largest_normal_force() const {
  double largest = 0;
  for (const Point& point : points_) largest = std::max(largest, point.normal);
  return largest;
}

double GroundPotential::grip(const Point& point, const Eigen::Vector2d& moved) const {
  return friction_ * point.normal / std::max(slip_, moved.norm());
}

double GroundPotential::add_forces(const Points& positions, Points& forces) const {
  double energy = 0;
  for_low_points(positions, [&](std::size_t p, const Vec3& at, double depth) {
    const Point& point = points_[p];
    const Eigen::Vector2d moved(at.x() - point.start.x(), at.z() - point.start.z());
    const double r = moved.norm();
    energy += 0.5 * point.stiffness * depth * depth;
    energy += friction_ * point.normal * (r < slip_ ? 0.5 * r * r / slip_ : r - 0.5 * slip_);
    const double held = grip(point, moved);
    const Vec3 force(-held * moved.x(), point.stiffness * depth, -held * moved.y());
    const auto& nodes = actor_.body.grid.nodes[static_cast<std::size_t>(point.contact.brick)];
    for (std::size_t c = 0; c < 8; ++c) {
      forces.row(nodes[c]) += point.contact.weights[static_cast<int>(c)] * force.transpose();
    }
  });
  return energy;
}

void GroundPotential::add_stiffness(const Points& positions, std::vector<PointStiffness>& points) const {
  for_low_points(positions, [&](std::size_t p, const Vec3& at, double depth) {
    const Point& point = points_[p];
    const Eigen::Vector2d moved(at.x() - point.start.x(), at.z() - point.start.z());
    PointStiffness held{.brick = point.contact.brick, .weights = point.contact.weights};
    const double grip_now = grip(point, moved);
    Eigen::Matrix2d tangential = grip_now * Eigen::Matrix2d::Identity();
    if (moved.norm() > slip_) tangential -= grip_now * moved * moved.transpose() / moved.squaredNorm();
    held.stiffness(0, 0) = tangential(0, 0);
    held.stiffness(0, 2) = tangential(0, 1);
    held.stiffness(2, 0) = tangential(1, 0);
    held.stiffness(2, 2) = tangential(1, 1);
    held.stiffness(1, 1) = depth > 0 ? point.stiffness : 0;
    points.push_back(held);
  });
}

}  // namespace sprung
