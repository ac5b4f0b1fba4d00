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
/// All constraints are met together by accelerated projected gradients (H. Mazhar, T. Heyn, D. Negrut, A. Tasora,
/// "Using Nesterov's method to accelerate multibody dynamics with friction and contact", ACM Transactions on Graphics
/// 34(3), 2015), with the row sums of the constraints' coupling as their step. In a sweep each constraint sees the same
/// velocities, so that the order of the constraints does not matter: a symmetric impact stays symmetric but for
/// rounding. Deterministic.
class ContactSolver {
 public:
  /// `inverse_masses` by body of the group and node, 1/kg; 0 for pinned nodes. `glue` by rows of the group.
  /// `skin_contacts`: of the group; none: new ones.
  ContactSolver(Group group, std::vector<Eigen::VectorXd> inverse_masses, std::vector<GluedPoint> glue = {},
                std::shared_ptr<SkinContacts> skin_contacts = nullptr);

  /// Changes the bodies' velocities so that moving by dt keeps every constraint. `elapsed`: since the obstacles were
  /// where the world has them, s.
  void apply(const World& world, double elapsed, double dt);

 private:
  /// One of the nodes that constraints push.
  struct SolverNode {
    std::size_t body;
    int node;
    double inverse_mass;
    double row_sum = 0;        // of all constraints, for a unit of impulse each
    Vec3 free_velocity;        // without impulses
    Vec3 velocity;             // with those ahead
    Vec3 last = Vec3::Zero();  // impulse of the sweep before
    Vec3 now = Vec3::Zero();   // and of this one
  };
  using Nodes = std::vector<SolverNode>;
  /// What a constraint pushes.
  template <class Impulse>
  struct Iterate {
    Impulse last;   // in the sweep before
    Impulse ahead;  // where the sweeps lead
  };
  /// A node's share in a contact.
  struct JacobianEntry {
    std::size_t index;  // in nodes_
    double weight;
  };
  struct ContactConstraint {
    std::uint64_t key;                       // of the node it works at, increasing
    std::span<const JacobianEntry> entries;  // in entries_
    Vec3 normal;
    Vec3 goal;  // m/s
    double friction;
    bool is_glue;
    double inverse_mass = 0;  // bounds how all constraints together respond to an impulse here
    Iterate<Vec3> impulse{Vec3::Zero(), Vec3::Zero()};

    [[nodiscard]] std::size_t count() const { return entries.size(); }
    [[nodiscard]] std::size_t index(std::size_t i) const { return entries[i].index; }
    [[nodiscard]] double weight(std::size_t i) const { return std::abs(entries[i].weight); }
    /// Of velocity to what the constraint asks, sideways too.
    [[nodiscard]] Vec3 residual(const Nodes& all, Vec3 SolverNode::*velocity) const;
    void push(const Vec3& size, Nodes& all) const;
    /// What it may push.
    [[nodiscard]] Vec3 allowed(const Vec3& size) const;
  };
  struct InversionConstraint {
    std::uint64_t key;                   // of the node it works at, increasing
    std::array<std::size_t, 8> nodes{};  // rows of nodes_
    std::array<Vec3, 8> gradients{};
    double least_speed;
    std::size_t node_count = 0;
    double inverse_mass = 0;
    Iterate<double> impulse{0, 0};

    [[nodiscard]] std::size_t count() const { return node_count; }
    [[nodiscard]] std::size_t index(std::size_t i) const { return nodes[i]; }
    [[nodiscard]] double weight(std::size_t i) const { return gradients[i].norm(); }
    [[nodiscard]] double residual(const Nodes& all, Vec3 SolverNode::*velocity) const;
    void push(double size, Nodes& all) const;
    [[nodiscard]] static double allowed(double size);
  };

  std::size_t row_of(std::size_t body, int node);
  void clear_constraints();
  /// Whether free nodes carry more than a trace of its weights; the impulse that moves the rest would be unbounded
  /// where pinned nodes carry nearly all.
  [[nodiscard]] bool can_be_moved(std::span<const JacobianEntry> entries) const;
  void find_contacts(const World& world, double elapsed, double dt);
  void find_inversions(double dt);
  void add_inversions(std::size_t body, const std::vector<InversionRate>& rates);
  void compute_row_sums();
  /// Takes over the best share of the step before's impulses.
  void warm_start();
  /// How far a sweep changed the impulses, as speeds (m/s), and whether the acceleration still points downhill.
  struct Sweep {
    double furthest = 0;
    double uphill = 0;
  };
  [[nodiscard]] Sweep sweep();
  /// Does the same to every constraint of either kind.
  template <class Visit>
  void each_constraint(const Visit& visit) {
    for (ContactConstraint& constraint : contacts_) visit(constraint);
    for (InversionConstraint& constraint : inversions_) visit(constraint);
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
  std::vector<InversionGuard> inversion_guards_;
  ContactList found_;
  std::vector<JacobianEntry> entries_;
  std::vector<ContactConstraint> contacts_;
  std::vector<InversionConstraint> inversions_;
  std::vector<ContactConstraint> contacts_before_;  // in the step before, without their entries
  std::vector<InversionConstraint> inversions_before_;
  Nodes nodes_;
  std::vector<std::vector<int>> rows_;  // by body, by node: in nodes_, or -1
};

}  // namespace sprung
