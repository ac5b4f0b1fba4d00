#pragma once
#include <array>
#include <vector>

#include "core/world/ground_contact.h"
#include "core/world/squeeze.h"

namespace sprung {

/// Keeps an actor out of the ground and its bricks from being pressed flat or inside out, by impulses on the nodes.
/// The impulse that stops a point on the ground carries Coulomb friction, which holds the point entirely below the
/// friction angle. The impulse that stops a brick's collapse goes along the gradient of its volume, which neither moves
/// nor turns the body: linear and angular momentum are kept exactly; like any inelastic impact it takes energy, never
/// gives it.
///
/// All limits are met together, in sweeps. In a sweep each limit sees the same velocities and a node's mass shared
/// evenly among the limits that pull at it (mass splitting: R. Tonge, F. Benevolenski, A. Voroshilov, "Mass splitting
/// for jitter-free parallel rigid body simulation", SIGGRAPH 2012), so that the order of the limits does not matter: a
/// symmetric impact stays symmetric but for rounding. Deterministic.
class Impulses {
 public:
  /// `inverse_masses` per node, 1/kg; 0 for nodes that are held.
  Impulses(const Actor& actor, Eigen::VectorXd inverse_masses);

  /// Changes actor.body.velocities so that moving by dt keeps every limit.
  void apply(const World& world, double dt, Actor& actor);

 private:
  struct Pull {
    int node;
    Vec3 gradient;  // of what is limited, by the node's place
    double weight;  // of the node in the point that rubs; 0: nothing does
  };
  struct Limit {
    std::array<Pull, 8> pulls;
    std::size_t pull_count = 0;
    double friction = 0;
    double least_rate = 0;    // of what is limited, its unit a second
    double tolerance = 0;     // of that rate
    double inverse_mass = 0;  // of what is limited, with shared node masses
    double normal = 0;        // impulse so far
    Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
  };

  [[nodiscard]] static Limit limit_of(const Touch& touch, const Ground& ground, const Body& body);
  [[nodiscard]] static Limit limit_of(const Squeeze& squeeze, const Body& body);
  void find_limits(const World& world, double dt, const Body& body);
  void share_masses();
  /// Returns by how many tolerances the worst limit was changed.
  double sweep(Body& body);
  double push(const Points& velocities, Limit& limit);

  Eigen::VectorXd inverse_masses_;
  GroundContact contact_;
  SqueezeWatch squeezes_;
  std::vector<Limit> limits_;
  int most_sweeps_ = 0;
  std::vector<int> touched_;  // nodes that a limit pulls at
  Eigen::VectorXd shares_;    // per node: how many limits pull at it
  Points changes_;            // per node: of its velocity in this sweep, m/s
};

}  // namespace sprung
