#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/contact/inversion_guard.h"
#include "core/contact/obstacle_contact.h"
#include "core/contact/skin_contact.h"

namespace sprung {

/// Keeps the bodies of a group from penetrating obstacles, each other and themselves, keeps glued points together, and
/// bricks from being flattened or inverted, by impulses on the nodes. The impulse that stops a point includes Coulomb
/// friction, which sticks entirely below the friction angle; between bodies it acts equally on both. The impulse that
/// stops a brick's collapse is along the gradient of its volume, which neither moves nor turns the body: linear and
/// angular momentum are conserved exactly; like any inelastic impact it dissipates energy, never adds it.
///
/// All constraints are solved together by accelerated projected gradients (H. Mazhar, T. Heyn, D. Negrut, A. Tasora,
/// "Using Nesterov's method to accelerate multibody dynamics with friction and contact", ACM Transactions on Graphics
/// 34(3), 2015), with step sizes from the row sums of the constraints' coupling. In a sweep each constraint sees the
/// same velocities, so that the order of the constraints does not matter: a symmetric impact stays symmetric up to
/// rounding. Deterministic.
class ContactSolver {
 public:
  /// `inverse_masses` by body of the group and node, 1/kg; 0 for pinned nodes. `glue` by rows of the group.
  /// `skin_contacts`: of the group; none: new ones.
  ContactSolver(Group group, std::vector<Eigen::VectorXd> inverse_masses, std::vector<GluedPoint> glue = {},
                std::shared_ptr<SkinContacts> skin_contacts = nullptr);

  /// Changes the bodies' velocities so that a step of dt satisfies every constraint. `elapsed`: since the obstacles had
  /// the world's poses, s.
  void apply(const World& world, double elapsed, double dt);

 private:
  /// A node that constraints act on.
  struct SolverNode {
    std::size_t body;
    int node;
    double inverse_mass;
    double row_sum = 0;        // of all constraints, for a unit of impulse each
    Vec3 free_velocity;        // without impulses
    Vec3 velocity;             // with the extrapolated ones
    Vec3 last = Vec3::Zero();  // impulse of the previous sweep
    Vec3 now = Vec3::Zero();   // and of this one
  };
  using Nodes = std::vector<SolverNode>;
  /// The impulse of a constraint.
  template <class Impulse>
  struct Iterate {
    Impulse last;   // in the previous sweep
    Impulse ahead;  // extrapolated
  };
  /// A node's share in a contact.
  struct JacobianEntry {
    std::size_t index;  // in nodes_
    double weight;
  };
  struct ContactConstraint {
    std::uint64_t key;                       // of the node it acts on, increasing
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
    /// The velocity relative to the constraint's goal, including the tangential part.
    [[nodiscard]] Vec3 residual(const Nodes& all, Vec3 SolverNode::*velocity) const;
    void push(const Vec3& size, Nodes& all) const;
    /// Projects an impulse onto the admissible ones.
    [[nodiscard]] Vec3 allowed(const Vec3& size) const;
  };
  struct InversionConstraint {
    std::uint64_t key;                   // of the node it acts on, increasing
    std::array<std::size_t, 8> nodes{};  // rows of nodes_
    std::array<Vec3, 8> gradients{};
    double min_speed;
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
  /// Whether free nodes carry more than a trace of its weights; the impulse that moves the rest would be unbounded if
  /// pinned nodes carried nearly all.
  [[nodiscard]] bool can_be_moved(std::span<const JacobianEntry> entries) const;
  void find_contacts(const World& world, double elapsed, double dt);
  void find_inversions(double dt);
  void add_inversions(std::size_t body, const std::vector<InversionRate>& rates);
  void compute_row_sums();
  /// Reuses the best multiple of the previous step's impulses.
  void warm_start();
  /// How far a sweep changed the impulses, as speeds (m/s), and whether the acceleration is still a descent direction.
  struct Sweep {
    double furthest = 0;
    double uphill = 0;
  };
  [[nodiscard]] Sweep sweep();
  /// Calls `visit` for every constraint of either kind.
  template <class Visit>
  void each_constraint(const Visit& visit) {
    for (ContactConstraint& constraint : contacts_) visit(constraint);
    for (InversionConstraint& constraint : inversions_) visit(constraint);
  }
  /// Starts the next sweep ahead of this one's result by `lead` times its change.
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
  std::vector<ContactConstraint> contacts_before_;  // of the previous step, without their entries
  std::vector<InversionConstraint> inversions_before_;
  Nodes nodes_;
  std::vector<std::vector<int>> rows_;  // by body, by node: in nodes_, or -1
};

}  // namespace sprung
