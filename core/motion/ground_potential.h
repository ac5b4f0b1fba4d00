#pragma once
#include "core/motion/newton_system.h"
#include "core/world/contact_skin.h"

namespace sprung {

/// Contact with the ground as an energy, for steps that look for a minimum: each contact point below the ground is
/// pushed back by k times its depth, k twenty times the stiffness E h of a brick, shared among the points of the brick.
/// So the ground gives way by a small part of what the body itself is pressed, well below 2 % of its size at rest.
/// Friction is Coulomb's with the normal force of the iteration before: a point that has moved by r in the step is held
/// back by mu N min(r / slip, 1), where slip is how far a point may creep in a step before it slides. (Li et al.,
/// "Incremental Potential Contact", 2020, has friction as an energy in this way.) Limits: points sink in by a little;
/// what sticks creeps, by slip_speed at most; no restitution.
class GroundPotential {
 public:
  /// Level ground at `height` (m) with Coulomb's coefficient `friction`; `slip_speed` in m/s.
  GroundPotential(const Actor& actor, double height, double friction, double slip_speed);

  /// Takes down where the points are; friction is measured from there, over a step of dt.
  void begin(const Points& positions, double dt);
  /// Takes the normal forces, for friction, from where the points are now. Returns the largest change, N.
  double update_friction(const Points& positions);
  [[nodiscard]] double largest_normal_force() const;

  /// J; adds forces (m x 3, N).
  double add_forces(const Points& positions, Points& forces) const;
  void add_stiffness(const Points& positions, std::vector<PointStiffness>& points) const;

 private:
  struct Point {
    ContactPoint contact;
    double stiffness = 0;  // N/m
    Vec3 start = Vec3::Zero();
    double normal = 0;  // N, for friction
  };

  /// Force per length of the tangential movement, and whether the point slides.
  [[nodiscard]] double grip(const Point& point, const Eigen::Vector2d& moved) const;
  template <class Visit>
  void for_low_points(const Points& positions, const Visit& visit) const;

  const Actor& actor_;
  double height_;
  double friction_;
  double slip_speed_;
  double slip_ = 0;            // m
  std::vector<Point> points_;  // grouped by brick
  std::vector<int> first_;     // of each brick that holds points
  std::vector<int> bricks_;
};

}  // namespace sprung
