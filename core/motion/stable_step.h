#pragma once
#include "core/world/world.h"

namespace sprung {

/// Largest step (s) that is stable for every actor: from the largest eigenvalue of a single brick with its own lumped
/// mass, which bounds the assembled one, with the damping that explicit steps have and `safety` taken off. Bricks that
/// are pressed flat one way and drawn out another are stiffer: it is for the state that the bodies are in.
[[nodiscard]] double stable_step(const World& world, double safety = 0.7);
[[nodiscard]] double stable_step(const Body& body, double safety = 0.7);

/// The square of the fastest frequency (1/s^2) that any node of the body can see.
[[nodiscard]] double largest_frequency_squared(const Body& body);

}  // namespace sprung
