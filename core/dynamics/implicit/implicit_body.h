#pragma once
#include <memory>
#include <vector>

#include "core/body/forces.h"
#include "core/contact/obstacle_potential.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/world/loads.h"
#include "core/world/world.h"

namespace sprung {

/// A relative change of a normal force below which friction needs no further pass.
inline constexpr double kSettledFriction = 0.05;

/// The muscles of a body as an energy, for steps that minimise a potential; see MuscleTension.
class MusclePotential {
 public:
  /// The body must outlive it.
  explicit MusclePotential(const SoftBody& body) : body_(body) {}

  /// Begins a step, with the muscles' current contraction.
  void begin();

  /// The energy at the body's current positions, J; adds forces (m x 3, N).
  double add_forces(Points& forces) const;
  /// Tension stiffens a brick against rotation, compression softens it; with `definite` the latter is left out.
  void add_stiffness(bool definite, std::vector<PointStiffness>& points) const;

 private:
  /// One of a brick's directions e_i.
  struct Draw {
    int brick;
    CornerWeights weights;  // of the brick's corners in F e_i, 1/m
    Vec3 along;             // F e_i
    double energy;          // J, for a length of one
  };
  template <class Visit>
  void for_draws(const Visit& visit) const;

  const SoftBody& body_;
  std::vector<MuscleTension> tensions_;  // by muscle
};

/// One body's contribution to the potential that an implicit step minimises, see ImplicitMotion: everything but contact
/// with other bodies and itself, and glue.
class ImplicitBody {
 public:
  /// All must outlive it.
  ImplicitBody(SoftBody& body, const World& world, const ImplicitOptions& options);

  /// Begins a step of dt, after obstacles have moved for `elapsed` (s). Pinned nodes are then at their final positions,
  /// the others unchanged; velocities are zero: damping comes from the potential.
  void begin(double elapsed, double dt);
  /// Moves nodes that are not pinned along the velocities, or back.
  void drift();
  void stay();

  /// The potential (J) at the positions, and its forces; others' may be added to them.
  double evaluate();
  [[nodiscard]] Points& forces() { return forces_; }
  /// Zeroes the forces on pinned nodes.
  void release_held();
  /// Returns whether the residual forces are small relative to those at work.
  [[nodiscard]] bool has_converged() const;
  /// The rounding error of the potential, J.
  [[nodiscard]] double noise() const;
  /// Updates normal forces, for friction, at the current positions; false if they changed by much.
  [[nodiscard]] bool settle_friction();

  /// Newton's matrix at the positions, by itself or as a part of a coupled system.
  [[nodiscard]] bool linearize(bool definite);
  [[nodiscard]] bool linearize(bool definite, std::vector<PointStiffness> coupled);
  [[nodiscard]] Eigen::VectorXd solve(double tolerance);

  void finish(double dt);
  /// Restores the body to its state before the step began, or before it was finished.
  void undo();

  /// The state besides positions and velocities that the next step depends on.
  void serialize(IntegratorState& state);

  [[nodiscard]] SoftBody& body() const { return body_; }
  [[nodiscard]] const Supports& supports() const { return supports_; }
  [[nodiscard]] double slip_speed() const { return slip_speed_; }
  [[nodiscard]] SolveReport solves() const { return alone_->report(); }
  [[nodiscard]] Eigen::VectorXd& penetrations() { return history_.penetrations; }
  [[nodiscard]] IterativeSolver& system() { return *coupled_; }

 private:
  /// Data of a step that can be undone.
  struct History {
    bool is_there = false;
    double last_dt = 0;
    Points positions;
    Points velocities;
    Eigen::VectorXd penetrations;  // of its skin's points, m, see SkinPotential
  };

  void aim(double dt);
  void hold(double elapsed, double dt);
  void take_terms(bool definite);

  SoftBody& body_;
  const World& world_;
  const ImplicitOptions& options_;
  Supports supports_;
  double size_;        // m
  double slip_speed_;  // m/s
  double stiffness_;   // N/m, the largest of a brick
  std::vector<ObstaclePotential> obstacles_;
  MusclePotential muscles_;
  std::unique_ptr<LinearSolver> alone_ = make_default_solver();
  std::unique_ptr<IterativeSolver> coupled_ = make_multigrid_solver();
  StepTerms terms_;

  // of the current step
  double span_ = 0;               // s
  double reach_ = 0;              // m, from the origin
  Points positions_;              // before it
  Points velocities_;             // before it
  Points pinned_start_;           // where nodes stay, except for pinned ones
  Points origin_;                 // x0
  Points goal_;                   // positions by inertia and gravity alone
  double mass_factor_ = 0;        // 1/s^2
  double weight_ = 0;             // N, plus the magnitude of the loads
  double support_stiffness_ = 0;  // N/m, the largest of a foundation's spring

  History history_;  // of the previous step
  History before_;   // as it was before the current step

  ForceWorkspace workspace_;
  ProductWorkspace products_;
  Points forces_;
  double work_ = 0;  // magnitude of the forces at work, N
};

}  // namespace sprung
