#pragma once
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// A contact point that is below the ground or about to be.
struct Touch {
  int brick;                            // that it rides in
  int corner;                           // of the brick, the nearest
  Eigen::Matrix<double, 8, 1> weights;  // of the brick's corners
  double least_speed;                   // upwards, that it must have at least, m/s
};

/// Finds the contact points of an actor that the ground has to hold. A point may come as near in one step as touching.
/// One found below comes up within about twenty steps, but no faster than a throw that would just reach the surface:
/// what starts a little too deep is lifted, not shot out.
class GroundContact {
 public:
  explicit GroundContact(const Actor& actor);

  /// Points that moving by dt would leave below the ground, at most one near each corner of a brick: the one that lies
  /// deepest. The others are held by it or found in the next step. `gravity` in m/s^2, its size.
  [[nodiscard]] const std::vector<Touch>& find(const Ground& ground, double gravity, double dt, const Body& body);

 private:
  struct Point {
    Eigen::Matrix<double, 8, 1> weights;  // of its brick's corners
    Eigen::Index corner;                  // the nearest
  };
  struct Candidate {
    const Point* point = nullptr;
    double pull = 0;  // upwards, that meeting its limit takes, m/s; more where it is near its corner
    double least_speed = 0;
  };

  std::vector<Point> points_;     // grouped by brick
  std::vector<int> first_point_;  // per brick, one past the end at the last
  std::vector<int> bricks_;       // bricks that hold points
  std::vector<Touch> touches_;
};

}  // namespace sprung
