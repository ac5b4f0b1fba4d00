#pragma once
#include <algorithm>
#include <vector>

#include "core/contact/point_stiffness.h"
#include "core/contact/search/contact_surface.h"
#include "core/types.h"

namespace sprung {

/// What pushes back a contact point of a body that is inside something, in steps that have contact as an energy, N/m
/// by point: twenty times the stiffness E h of its brick, shared among the points of the brick.
[[nodiscard]] std::vector<double> contact_stiffness(const SoftBody& body, const ContactSurface& skin);

/// The same of two bodies that touch: by the softer of the bricks.
[[nodiscard]] double pair_stiffness(double hardness, const Body& body, int brick, const Body& other, int other_brick);

/// N/m, of a point that is glued to another body at those bricks.
[[nodiscard]] double glue_stiffness(const Body& body, int brick, const Body& other, int other_brick);

/// Coulomb's friction of a pressed point as an energy, smooth where it sticks: it grows with the square of the way up
/// to `slip`, in proportion beyond (Li et al., "Incremental Potential Contact", 2020).
class FrictionPotential {
 public:
  /// `moved` (m) since the step began, of which only what lies across the unit `normal` counts; `most` (N): coefficient
  /// times normal force; `slip` (m): that a point may creep before it slides.
  FrictionPotential(const Vec3& moved, const Vec3& normal, double most, double slip)
      : way_(moved - normal.dot(moved) * normal), normal_(normal), length_(way_.norm()), most_(most), slip_(slip) {}

  /// J.
  [[nodiscard]] double energy() const {
    return most_ * (length_ < slip_ ? 0.5 * length_ * length_ / slip_ : length_ - 0.5 * slip_);
  }
  /// What holds the point back, N.
  [[nodiscard]] Vec3 force() const { return -pull() * way_; }
  /// Of that force, N/m: symmetric, no negative eigenvalue.
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

/// Contact of a body with an obstacle as an energy, for steps that look for a minimum: each contact point inside the
/// obstacle is pushed back by k times its depth, k twenty times the stiffness E h of a brick, shared among the points
/// of the brick. So the obstacle gives way by a small part of what the body itself is pressed, well below 2 % of its
/// size at rest. Friction is Coulomb's with the normal force of the iteration before: a point that has moved by r in
/// the step along the obstacle is held back by mu N min(r / slip, 1), where slip is how far a point may creep in a step
/// before it slides. (Li et al., "Incremental Potential Contact", 2020, has friction as an energy in this way.) Limits:
/// points sink in by a little; what sticks creeps, by slip_speed at most; no restitution.
class ObstaclePotential {
 public:
  /// `slip_speed` in m/s. Both have to outlive it.
  ObstaclePotential(SoftBody& body, const Obstacle& obstacle, double slip_speed);

  /// Before a step of dt that begins when the obstacle has moved by itself for `elapsed` (s): friction is measured from
  /// where its material carries the points meanwhile.
  void begin(const Points& positions, double elapsed, double dt);
  /// Takes normals and normal forces, for friction, from where the points are now. Returns the largest change of a
  /// force, N, where there is friction.
  double update_friction(const Points& positions);
  [[nodiscard]] double largest_normal_force() const;

  /// J; adds forces (m x 3, N).
  double add_forces(const Points& positions, Points& forces);
  void add_stiffness(const Points& positions, std::vector<PointStiffness>& points);

 private:
  struct Point {
    double stiffness = 0;  // N/m
    Vec3 start = Vec3::Zero();
    double pressing = 0;         // N, for friction
    Vec3 normal = Vec3::Zero();  // likewise
  };
  /// What was last asked about a brick's middle, in the obstacle's frame.
  struct Asked {
    Vec3 position = Vec3::Zero();
    double distance = 0;  // m; 0: nothing was asked
  };

  [[nodiscard]] bool is_far(std::size_t brick, const Points& positions);
  [[nodiscard]] FrictionPotential friction_at(const Point& point, const Vec3& position) const;
  template <class Visit>
  void for_touching_points(const Points& positions, const Visit& visit);

  const SoftBody& body_;
  const Obstacle& obstacle_;
  const ContactSurface& skin_;
  double slip_speed_;
  double slip_ = 0;            // m
  Pose pose_;                  // at the end of the step
  std::vector<Point> points_;  // of the skin
  std::vector<Asked> asked_;   // of the skin's bricks
};

}  // namespace sprung
