#pragma once
#include <string>
#include <string_view>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/simulation/scene.h"

namespace sprung {

/// How a world is moved from frame to frame.
struct StepPlan {
  Solver scheme = Solver::kEuler;  // kEuler, kVerlet, kImplicitEuler or kBdf2
  Steps steps;                     // of a frame; explicit ones: of the body that needs most
  double brick_steps = 0;          // of a frame
  std::string reason;              // why this scheme, where it was left open

  [[nodiscard]] bool is_implicit() const { return scheme == Solver::kImplicitEuler || scheme == Solver::kBdf2; }
};

/// What makes a motion by that plan quicker.
[[nodiscard]] std::string_view remedy_for(const StepPlan& plan);

/// A sentence where a frame takes very many steps; else empty.
[[nodiscard]] std::string warning_of(const StepPlan& plan);

/// The steps of the scene's scheme. Explicit ones are as long as the stiffest brick allows, implicit ones follow the
/// slowest vibration of the bodies, 2 to 16 a frame. Solver::kAuto takes what is forecast to be quicker: explicit steps
/// (Solver::kEuler), or BDF2 where those would be so many that one implicit step, as dear as some 300 of them or, where
/// bodies touch, 600, saves half of the time at least. Throws Error(kBadInput) where implicit steps are asked for that
/// cannot do what is there.
[[nodiscard]] StepPlan plan_steps(const World& world, const Scene& scene);

}  // namespace sprung
