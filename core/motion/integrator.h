#pragma once
#include "core/world/world.h"

namespace sprung {

enum class Scheme { kSymplecticEuler, kVerlet };

/// Largest step (s) that is stable for every actor: from the largest eigenvalue of a single brick with its own lumped
/// mass, which bounds the assembled one, with damping and `safety` taken off. See stable_step.cpp.
[[nodiscard]] double stable_step(const World& world, double safety = 0.7);

/// Moves the world by `steps` steps of `dt` seconds. Deterministic for any number of threads.
/// Throws Error(kDiverged) naming time `time` and the body where a position is no longer finite.
void advance(World& world, Scheme scheme, double dt, long steps, double time);

}  // namespace sprung
