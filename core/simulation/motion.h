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

/// Moves a simulation through time as its scene says: pins, loads and obstacles along their keyframes, bodies by the
/// scene's scheme. Deterministic for any number of threads.
class SceneMotion {
 public:
  using Between = AdaptiveIntegrator::Between;
  using Tell = AdaptiveIntegrator::Tell;

  /// Both have to outlive it. Throws Error(kBadInput) where the scheme cannot do what is there.
  SceneMotion(Simulation& simulation, const Scene& scene);

  /// From `begin` to `end` (s), which are `duration` apart: frames that shall be equal to the last bit say the same.
  /// Throws Diverged.
  void advance(double begin, double end, double duration, const Between& between, const Tell& tell);

  /// What the next time step depends on beside positions and velocities.
  void serialize(IntegratorState& state);

  /// The steps are those of the last frame, of the body that took most.
  [[nodiscard]] const StepPlan& plan() const { return plan_; }
  /// Of implicit steps; none: steps are explicit.
  [[nodiscard]] std::optional<ImplicitMotion::Report> implicit_report() const;
  /// Forces of the pins by body (m x 3, N), as the bodies stand: what accelerates a held node's own mass is left out.
  [[nodiscard]] std::vector<Points> pin_reactions() const;

 private:
  void advance_piece(double begin, double duration, const Between& between, const Tell& tell);

  World& world_;
  SceneDriver driver_;
  StepPlan plan_;
  AdaptiveIntegrator explicit_;
  std::optional<ImplicitMotion> implicit_;
};

}  // namespace sprung
