#pragma once
#include <span>

#include "core/world/world.h"

namespace sprung {

enum class Scheme { kSymplecticEuler, kVerlet };

/// Equal steps that fill a time exactly.
struct Steps {
  long count = 1;
  double dt = 0;  // s
};

/// Largest step (s) that is stable for every actor: from the largest eigenvalue of a single brick with its own lumped
/// mass, which bounds the assembled one, with damping and `safety` taken off. See stable_step.cpp.
[[nodiscard]] double stable_step(const World& world, double safety = 0.7);
[[nodiscard]] double stable_step(const Body& body, double safety = 0.7);

/// Moves each actor of the world by its own steps, all at once: actors do not touch each other. Deterministic for any
/// number of threads. `steps`: one entry per actor, all filling the same time.
/// Throws Error(kDiverged) naming time `time` and the body where a position is no longer finite.
void advance(World& world, Scheme scheme, std::span<const Steps> steps, double time);

/// The same with `steps` steps of `dt` seconds for all.
void advance(World& world, Scheme scheme, double dt, long steps, double time);

}  // namespace sprung
