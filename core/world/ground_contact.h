#pragma once
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// A contact point that is below the ground or about to be.
struct Touch {
  int brick;                            // that it rides in
  Eigen::Matrix<double, 8, 1> weights;  // of the brick's corners
  double least_speed;                   // upwards, that it must have at least, m/s
};

/// Finds the contact points of an actor that the ground has to hold. A point may come as near in one step as touching.
/// One found below comes up within about twenty steps, but no faster than a throw that would just reach the surface:
/// what starts a little too deep is lifted, not shot out.
class GroundContact {
 public:
  explicit GroundContact(const Actor& actor);

  /// Points that moving by dt would leave below the ground. `gravity` in m/s^2, its size.
  [[nodiscard]] const std::vector<Touch>& find(const Ground& ground, double gravity, double dt, const Body& body);

 private:
  std::vector<Eigen::Matrix<double, 8, 1>> weights_;  // of the contact points, grouped by brick
  std::vector<int> first_point_;                      // per brick, one past the end at the last
  std::vector<int> bricks_;                           // bricks that hold points
  std::vector<Touch> touches_;
};

}  // namespace sprung
