#pragma once
#include <array>
#include <cmath>
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
/// All limits are met together by accelerated projected gradients (H. Mazhar, T. Heyn, D. Negrut, A. Tasora, "Using
/// Nesterov's method to accelerate multibody dynamics with friction and contact", ACM Transactions on Graphics 34(3),
/// 2015), with the row sums of the limits' coupling as their step. In a sweep each limit sees the same velocities, so
/// that the order of the limits does not matter: a symmetric impact stays symmetric but for rounding. Deterministic.
class Impulses {
 public:
  /// `inverse_masses` per node, 1/kg; 0 for nodes that are held.
  Impulses(const Actor& actor, Eigen::VectorXd inverse_masses);

  /// Changes actor.body.velocities so that moving by dt keeps every limit.
  void apply(const World& world, double dt, Actor& actor);

 private:
  /// One of the nodes that limits push.
  struct Pushed {
    int node;
    double inverse_mass;
    double pull = 0;           // of all limits, for a unit of impulse each
    Vec3 free_velocity;        // without impulses
    Vec3 velocity;             // with those ahead
    Vec3 last = Vec3::Zero();  // impulse of the sweep before
    Vec3 now = Vec3::Zero();   // and of this one
  };
  using Nodes = std::vector<Pushed>;
  /// What a limit pushes.
  template <class Impulse>
  struct Iterate {
    Impulse last;   // in the sweep before
    Impulse ahead;  // where the sweeps lead
  };
  struct TouchLimit {
    int key;                           // of the place it works at, increasing
    std::array<std::size_t, 8> nodes;  // places in nodes_
    Eigen::Matrix<double, 8, 1> weights;
    double least_speed;
    double inverse_mass = 0;  // bounds how all limits together answer an impulse here
    Iterate<Vec3> impulse{Vec3::Zero(), Vec3::Zero()};

    [[nodiscard]] int count() const { return 8; }
    [[nodiscard]] double pull(int i) const { return std::abs(weights[i]); }
    /// Of speed to what the limit asks, sideways to rest.
    [[nodiscard]] Vec3 lack(const Nodes& all, Vec3 Pushed::*velocity) const;
    void push(const Vec3& size, Nodes& all) const;
    /// What it may push.
    [[nodiscard]] static Vec3 allowed(Vec3 size, double friction);
  };
  struct SqueezeLimit {
    int key;                             // of the place it works at, increasing
    std::array<std::size_t, 8> nodes{};  // places in nodes_
    Eigen::Matrix<double, 3, 8> gradients;
    double least_speed;
    int node_count = 0;
    double inverse_mass = 0;
    Iterate<double> impulse{0, 0};

    [[nodiscard]] int count() const { return node_count; }
    [[nodiscard]] double pull(int i) const { return gradients.col(i).norm(); }
    [[nodiscard]] double lack(const Nodes& all, Vec3 Pushed::*velocity) const;
    void push(double size, Nodes& all) const;
    [[nodiscard]] static double allowed(double size, double friction);
  };

  std::size_t place_of(const Body& body, int node);
  void find_limits(const World& world, double dt, const Body& body);
  void bound_answers();
  /// Takes over a good share of the step before's impulses.
  void start_from_before();
  /// How far a sweep changed the impulses, as speeds (m/s), and whether the acceleration still points downhill.
  struct Sweep {
    double furthest = 0;
    double uphill = 0;
  };
  [[nodiscard]] Sweep sweep(double friction);
  /// Does the same to every limit of either kind.
  template <class Visit>
  void each_limit(const Visit& visit) {
    for (TouchLimit& limit : touches_) visit(limit);
    for (SqueezeLimit& limit : squeezed_) visit(limit);
  }
  /// The next sweep starts ahead of this one's end by `lead` times what it changed.
  void look_ahead(double lead);

  Eigen::VectorXd inverse_masses_;
  GroundContact contact_;
  SqueezeWatch squeezes_;
  std::vector<TouchLimit> touches_;
  std::vector<SqueezeLimit> squeezed_;
  std::vector<TouchLimit> touches_before_;  // in the step before
  std::vector<SqueezeLimit> squeezed_before_;
  Nodes nodes_;
  std::vector<int> places_;  // per node of the body: in nodes_, or -1
};

}  // namespace sprung
