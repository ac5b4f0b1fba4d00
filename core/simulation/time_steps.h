#pragma once
#include <string>
#include <string_view>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/simulation/scene.h"

namespace sprung {

/// The time integration of a world.
struct StepPlan {
  Solver scheme = Solver::kEuler;  // kEuler, kVerlet, kImplicitEuler or kBdf2
  Steps steps;                     // per frame; explicit ones: of the body that needs most
  double brick_steps = 0;          // per frame
  std::string reason;              // of the choice of the scheme; empty if the scene names it

  [[nodiscard]] bool is_implicit() const { return scheme == Solver::kImplicitEuler || scheme == Solver::kBdf2; }
};

/// Advice on what would make this motion faster.
[[nodiscard]] std::string_view remedy_for(const StepPlan& plan);

/// A warning if a frame takes very many steps; else empty.
[[nodiscard]] std::string warning_of(const StepPlan& plan);

/// The steps of the scene's scheme. Explicit ones are as long as the stiffest brick allows, implicit ones resolve the
/// slowest vibration of the bodies, 2 to 16 per frame. Solver::kAuto chooses what is expected to be faster: explicit
/// steps (Solver::kEuler), or BDF2 if implicit steps, as expensive as some 500 explicit ones each, 1000 with contact
/// between bodies, and several times that where bodies are thin, save at least half of the time. Throws
/// Error(kBadInput) if the scene requires implicit steps that do not support it.
[[nodiscard]] StepPlan plan_steps(const World& world, const Scene& scene);

}  // namespace sprung
