#pragma once
#include <vector>

#include "core/motion/grip.h"
#include "core/motion/newton_system.h"
#include "core/world/contact_skin.h"

namespace sprung {

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
  ObstaclePotential(Actor& actor, const Obstacle& obstacle, double slip_speed);

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
    Vec3 place = Vec3::Zero();
    double distance = 0;  // m; 0: nothing was asked
  };

  [[nodiscard]] bool is_far(std::size_t brick, const Points& positions);
  [[nodiscard]] Grip grip(const Point& point, const Vec3& place) const;
  template <class Visit>
  void for_touching_points(const Points& positions, const Visit& visit);

  const Actor& actor_;
  const Obstacle& obstacle_;
  const ContactSkin& skin_;
  double slip_speed_;
  double slip_ = 0;            // m
  Pose pose_;                  // at the end of the step
  std::vector<Point> points_;  // of the skin
  std::vector<Asked> asked_;   // of the skin's bricks
};

}  // namespace sprung
