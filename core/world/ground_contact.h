#pragma once
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Keeps the contact points of an actor out of the ground by impulses on the nodes they ride on. A point may come as
/// near in one step as touching; the impulse that stops it also carries Coulomb friction, which holds it entirely
/// below the friction angle. Several points of a body are satisfied in turn, in a fixed order, in a few sweeps
/// (projected Gauss-Seidel).
class GroundContact {
 public:
  /// `inverse_masses` per node, 1/kg; 0 for nodes that are held.
  GroundContact(const Actor& actor, Eigen::VectorXd inverse_masses);

  /// Changes actor.body.velocities so that moving by dt leaves no point below the ground.
  void apply(const Ground& ground, double dt, Actor& actor);

 private:
  struct Touch {
    int brick;
    Eigen::Matrix<double, 8, 1> weights;
    double inverse_mass;  // of the point, 1/kg
    double least_speed;   // upward speed that the point must have at least, m/s
    double normal = 0;    // impulse so far, N s
    Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
  };

  void find_touches(const Ground& ground, double dt, const Actor& actor);
  void solve(const Ground& ground, Touch& touch, Actor& actor) const;

  Eigen::VectorXd inverse_masses_;
  std::vector<int> points_;       // contact points grouped by brick
  std::vector<int> first_point_;  // per brick, one past the end at the last
  std::vector<int> bricks_;       // bricks that hold points
  std::vector<Touch> touches_;
};

}  // namespace sprung
