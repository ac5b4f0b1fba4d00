#pragma once
#include <optional>
#include <vector>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/dynamics/integrator_state.h"
#include "core/simulation/drivers.h"
#include "core/simulation/simulation.h"
#include "core/simulation/time_steps.h"

namespace sprung {

/// Advances a simulation in time: pins, loads and obstacles along their keyframes, bodies by the scene's scheme.
/// Deterministic for any number of threads.
class SceneMotion {
 public:
  using Between = AdaptiveIntegrator::Between;
  using Tell = AdaptiveIntegrator::Tell;

  /// Both must outlive it. Throws Error(kBadInput) if the scheme does not support the scene.
  SceneMotion(Simulation& simulation, const Scene& scene);

  /// From `begin` to `end` (s). `duration` is their difference, given so that equal frames have it bit-identical.
  /// Throws Diverged.
  void advance(double begin, double end, double duration, const Between& between, const Tell& tell);

  /// The state of the integrator besides positions and velocities.
  void serialize(IntegratorState& state);

  /// With the steps of the last frame, of the body that took most.
  [[nodiscard]] const StepPlan& plan() const { return plan_; }
  /// Covers all explicit steps so far.
  [[nodiscard]] const StepReport& report() const { return report_; }
  /// Likewise, each step counting the bricks that took it.
  [[nodiscard]] double brick_steps() const { return brick_steps_; }
  /// None for explicit steps.
  [[nodiscard]] std::optional<ImplicitMotion::Report> implicit_report() const;
  /// Reactions of the pins by body (m x 3, N) in the current state, without the inertia of the pinned nodes.
  [[nodiscard]] std::vector<Points> pin_reactions() const;

 private:
  void advance_piece(double begin, double duration, const Between& between, const Tell& tell);

  World& world_;
  SceneDriver driver_;
  StepPlan plan_;
  StepReport report_;
  double brick_steps_ = 0;
  AdaptiveIntegrator explicit_;
  std::optional<ImplicitMotion> implicit_;
};

}  // namespace sprung
