#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/contact/inversion_guard.h"
#include "core/contact/obstacle_contact.h"
#include "core/contact/skin_contact.h"

namespace sprung {

/// Keeps the bodies of a group out of obstacles, each other and themselves, what is glued together, and their bricks
/// from being pressed flat or inside out, by impulses on the nodes. The impulse that stops a point carries Coulomb
/// friction, which holds the point entirely below the friction angle; between bodies it pushes both alike. The impulse
/// that stops a brick's collapse goes along the gradient of its volume, which neither moves nor turns the body: linear
/// and angular momentum are kept exactly; like any inelastic impact it takes energy, never gives it.
///
/// All limits are met together by accelerated projected gradients (H. Mazhar, T. Heyn, D. Negrut, A. Tasora, "Using
/// Nesterov's method to accelerate multibody dynamics with friction and contact", ACM Transactions on Graphics 34(3),
/// 2015), with the row sums of the limits' coupling as their step. In a sweep each limit sees the same velocities, so
/// that the order of the limits does not matter: a symmetric impact stays symmetric but for rounding. Deterministic.
class ContactSolver {
 public:
  /// `inverse_masses` by actor of the group and node, 1/kg; 0 for nodes that are held. `glue` by rows of the group.
  /// `skin_contacts`: of the group; none: new ones.
  ContactSolver(Group group, std::vector<Eigen::VectorXd> inverse_masses, std::vector<GluedPoint> glue = {},
                std::shared_ptr<SkinContacts> skin_contacts = nullptr);

  /// Changes the bodies' velocities so that moving by dt keeps every limit. `elapsed`: since the obstacles were where
  /// the world has them, s.
  void apply(const World& world, double elapsed, double dt);

 private:
  /// One of the nodes that limits push.
  struct Pushed {
    std::size_t actor;
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
  /// A node's share in a touch.
  struct Part {
    std::size_t place;  // in nodes_
    double weight;
  };
  struct ContactConstraint {
    std::uint64_t key;            // of the place it works at, increasing
    std::span<const Part> parts;  // in parts_
    Vec3 normal;
    Vec3 goal;  // m/s
    double friction;
    bool is_glue;
    double inverse_mass = 0;  // bounds how all limits together answer an impulse here
    Iterate<Vec3> impulse{Vec3::Zero(), Vec3::Zero()};

    [[nodiscard]] std::size_t count() const { return parts.size(); }
    [[nodiscard]] std::size_t place(std::size_t i) const { return parts[i].place; }
    [[nodiscard]] double pull(std::size_t i) const { return std::abs(parts[i].weight); }
    /// Of velocity to what the limit asks, sideways too.
    [[nodiscard]] Vec3 residual(const Nodes& all, Vec3 Pushed::*velocity) const;
    void push(const Vec3& size, Nodes& all) const;
    /// What it may push.
    [[nodiscard]] Vec3 allowed(const Vec3& size) const;
  };
  struct InversionConstraint {
    std::uint64_t key;                   // of the place it works at, increasing
    std::array<std::size_t, 8> nodes{};  // places in nodes_
    std::array<Vec3, 8> gradients{};
    double least_speed;
    std::size_t node_count = 0;
    double inverse_mass = 0;
    Iterate<double> impulse{0, 0};

    [[nodiscard]] std::size_t count() const { return node_count; }
    [[nodiscard]] std::size_t place(std::size_t i) const { return nodes[i]; }
    [[nodiscard]] double pull(std::size_t i) const { return gradients[i].norm(); }
    [[nodiscard]] double residual(const Nodes& all, Vec3 Pushed::*velocity) const;
    void push(double size, Nodes& all) const;
    [[nodiscard]] static double allowed(double size);
  };

  std::size_t place_of(std::size_t actor, int node);
  void forget_limits();
  /// Not where nodes that are held carry nearly all of its weights: an impulse that is to move the rest would have no
  /// bound.
  [[nodiscard]] bool can_be_moved(std::span<const Part> parts) const;
  void find_contacts(const World& world, double elapsed, double dt);
  void find_inversions(double dt);
  void add_inversions(std::size_t actor, const std::vector<InversionRate>& squeezes);
  void compute_row_sums();
  /// Takes over a good share of the step before's impulses.
  void warm_start();
  /// How far a sweep changed the impulses, as speeds (m/s), and whether the acceleration still points downhill.
  struct Sweep {
    double furthest = 0;
    double uphill = 0;
  };
  [[nodiscard]] Sweep sweep();
  /// Does the same to every limit of either kind.
  template <class Visit>
  void each_limit(const Visit& visit) {
    for (ContactConstraint& limit : touches_) visit(limit);
    for (InversionConstraint& limit : squeezed_) visit(limit);
  }
  /// The next sweep starts ahead of this one's end by `lead` times what it changed.
  void extrapolate(double lead);

  Group group_;
  std::vector<Eigen::VectorXd> inverse_masses_;
  std::vector<GluedPoint> glue_;
  double smallest_brick_;  // m
  std::vector<const ContactSurface*> skins_;
  ObstacleContact obstacle_contact_;
  std::shared_ptr<SkinContacts> skin_contacts_;
  std::vector<InversionGuard> squeeze_watches_;
  ContactList found_;
  std::vector<Part> parts_;
  std::vector<ContactConstraint> touches_;
  std::vector<InversionConstraint> squeezed_;
  std::vector<ContactConstraint> touches_before_;  // in the step before, without their parts
  std::vector<InversionConstraint> squeezed_before_;
  Nodes nodes_;
  std::vector<std::vector<int>> places_;  // by actor, by node: in nodes_, or -1
};

}  // namespace sprung
