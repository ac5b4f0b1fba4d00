#pragma once
#include <vector>

#include "core/body/forces.h"
#include "core/motion/implicit_motion.h"
#include "core/motion/muscle_potential.h"
#include "core/motion/obstacle_potential.h"

namespace sprung {

/// Moves one actor by implicit steps, see ImplicitMotion.
class ImplicitStepper {
 public:
  /// All have to outlive it.
  ImplicitStepper(Actor& actor, const World& world, const ImplicitOptions& options);

  /// Obstacles have moved by themselves for `elapsed` (s) when it begins. False where no minimum was found; the body is
  /// then as before.
  [[nodiscard]] bool step(double elapsed, double dt);

  /// What the next step depends on beside positions and velocities.
  void pass(MotionMemory& memory);

  [[nodiscard]] SolveReport solves() const { return system_->report(); }
  [[nodiscard]] long steps() const { return steps_; }
  [[nodiscard]] long iterations() const { return iterations_; }

 private:
  void begin(double elapsed, double dt);
  void hold(double dt);
  void set_held_velocities();
  bool find_minimum();
  bool descend_to_minimum();
  /// The potential (J) at the positions; the forces on free degrees of freedom into forces_.
  double evaluate();
  bool newton_step(double potential);
  [[nodiscard]] Eigen::VectorXd direction();

  Actor& actor_;
  Body& body_;
  const World& world_;
  const ImplicitOptions& options_;
  Supports supports_;
  double size_;       // m
  double stiffness_;  // N/m, the largest of a brick
  double reach_ = 0;  // m, from the origin
  std::vector<ObstaclePotential> obstacles_;
  MusclePotential muscles_;
  std::unique_ptr<NewtonSystem> system_ = make_quick_system();
  StepTerms terms_;

  // of the step at hand
  double span_ = 0;         // s
  Points origin_;           // x0
  Points goal_;             // where inertia and gravity alone lead
  double mass_factor_ = 0;  // 1/s^2
  double weight_ = 0;       // N, and the size of the loads

  bool has_history_ = false;
  double last_dt_ = 0;
  Points before_;
  Points velocities_before_;

  ForceWorkspace workspace_;
  std::vector<double> room_;
  Points forces_;
  double work_ = 0;  // size of the forces at work, N
  long steps_ = 0;
  long iterations_ = 0;
};

}  // namespace sprung
