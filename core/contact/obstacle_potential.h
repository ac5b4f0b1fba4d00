#pragma once
#include <algorithm>
#include <vector>

#include "core/contact/search/contact_surface.h"
#include "core/types.h"
#include "core/world/point_stiffness.h"

namespace sprung {

/// The penalty stiffness of each contact point of a body, in steps that treat contact as an energy, N/m: twenty times
/// the stiffness E h of its brick, shared among the points of the brick.
[[nodiscard]] std::vector<double> contact_stiffness(const SoftBody& body, const ContactSurface& skin);

/// The same for two bodies in contact: that of the softer brick.
[[nodiscard]] double pair_stiffness(double stiffness, const Body& body, int brick, const Body& other, int other_brick);

/// The stiffness of a point that is glued to another body at these bricks, N/m.
[[nodiscard]] double glue_stiffness(const Body& body, int brick, const Body& other, int other_brick);

/// Coulomb friction of a loaded point as an energy, smooth where it sticks: quadratic in the displacement up to `slip`,
/// linear beyond (Li et al., "Incremental Potential Contact", 2020).
class FrictionPotential {
 public:
  /// `moved` (m): displacement in the step, of which only the part tangential to the unit `normal` counts; `most` (N):
  /// coefficient times normal force; `slip` (m): how far a point may creep before it slides.
  FrictionPotential(const Vec3& moved, const Vec3& normal, double most, double slip)
      : way_(moved - normal.dot(moved) * normal), normal_(normal), length_(way_.norm()), most_(most), slip_(slip) {}

  /// J.
  [[nodiscard]] double energy() const {
    return most_ * (length_ < slip_ ? 0.5 * length_ * length_ / slip_ : length_ - 0.5 * slip_);
  }
  /// The friction force on the point, N.
  [[nodiscard]] Vec3 force() const { return -pull() * way_; }
  /// Its stiffness, N/m: symmetric, no negative eigenvalue.
  [[nodiscard]] Mat3 stiffness() const {
    Mat3 along = Mat3::Identity() - normal_ * normal_.transpose();
    if (length_ > slip_) along -= way_ * way_.transpose() / (length_ * length_);
    return pull() * along;
  }

 private:
  [[nodiscard]] double pull() const { return most_ / std::max(slip_, length_); }  // N/m

  Vec3 way_;
  Vec3 normal_;
  double length_;
  double most_;
  double slip_;
};

/// Contact of a body with an obstacle as an energy, for steps that minimise a potential: each contact point inside the
/// obstacle is pushed back by k times its depth, k twenty times the stiffness E h of a brick, shared among the points
/// of the brick. So the penetration is a small part of the body's own compression, well below 2 % of its size at rest.
/// Friction is Coulomb's with the normal force of the previous iteration: a point that has slid by r along the obstacle
/// in the step is resisted by mu N min(r / slip, 1), where slip is the distance a point may creep in a step before it
/// slides. (Li et al., "Incremental Potential Contact", 2020, formulate friction as an energy in this way.) Limits:
/// points penetrate slightly; sticking points creep, by slip_speed at most; no restitution.
class ObstaclePotential {
 public:
  /// `slip_speed` in m/s. Both must outlive it.
  ObstaclePotential(SoftBody& body, const Obstacle& obstacle, double slip_speed);

  /// Begins a step of dt, after the obstacle has moved for `elapsed` (s): friction is measured relative to the motion
  /// of the obstacle's material.
  void begin(const Points& positions, double elapsed, double dt);
  /// Updates normals and normal forces, for friction, at the current positions. Returns the largest change of a force,
  /// N, if there is friction.
  double update_friction(const Points& positions);
  [[nodiscard]] double largest_normal_force() const;

  /// J; adds forces (m x 3, N).
  double add_forces(const Points& positions, Points& forces);
  void add_stiffness(const Points& positions, std::vector<PointStiffness>& points);

 private:
  struct Point {
    double stiffness = 0;  // N/m
    Vec3 start = Vec3::Zero();
    double normal_force = 0;     // N, for friction
    Vec3 normal = Vec3::Zero();  // likewise
  };
  /// The last distance query of a brick's middle, in the obstacle's frame.
  struct GapQuery {
    Vec3 position = Vec3::Zero();
    double distance = 0;  // m; 0: no query yet
  };

  [[nodiscard]] bool is_far(std::size_t brick, const Points& positions);
  [[nodiscard]] FrictionPotential friction_at(const Point& point, const Vec3& position) const;
  template <class Visit>
  void for_touching_points(const Points& positions, const Visit& visit);

  const SoftBody& body_;
  const Obstacle& obstacle_;
  const ContactSurface& skin_;
  double slip_speed_;
  double slip_ = 0;                // m
  Pose pose_;                      // at the end of the step
  std::vector<Point> points_;      // of the skin
  std::vector<GapQuery> queries_;  // of the skin's bricks
};

}  // namespace sprung
