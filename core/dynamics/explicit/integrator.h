#pragma once
#include <span>
#include <vector>

#include "core/world/world.h"

namespace sprung {

class ContactStates;

/// Largest step (s) that is stable for every body: by largest_frequency_squared() with the damping that explicit steps
/// have and `safety` taken off. Bricks that are pressed flat one way and drawn out another are stiffer: it is for the
/// state that the bodies are in.
[[nodiscard]] double stable_step(const World& world, double safety = 0.7);
[[nodiscard]] double stable_step(const Body& body, double safety = 0.7);

/// The square of the fastest frequency (1/s^2) that any node of the body can see: the largest eigenvalue of a single
/// brick with its own lumped mass, which bounds the assembled one; of solid bricks (Model::kNeoHooke) the assembled one
/// itself, a tenth added.
[[nodiscard]] double largest_frequency_squared(const Body& body);

enum class Scheme { kSymplecticEuler, kVerlet };

/// Equal steps that fill a time exactly.
struct Steps {
  long count = 1;
  double dt = 0;  // s
};

/// Actors that may touch each other, and the steps they take together.
struct GroupSteps {
  std::vector<std::size_t> bodies;  // rows of World::bodies
  Steps steps;
  double elapsed = 0;  // s, since obstacles were where the world has them
};

/// Moves each group of bodies by its own steps, all at once: only those of one group touch each other. Obstacles stay
/// as the world has them: it is for the caller to move them on. Deterministic for any number of threads.
/// Throws Error(kDiverged) naming time `time` and the body where a position is no longer finite.
/// `states`: of the groups; none: the search for contacts begins anew.
void advance(World& world, Scheme scheme, std::span<const GroupSteps> groups, double time,
             const ContactStates* states = nullptr);

/// The same with `steps` steps of `dt` seconds for all; moves the obstacles too.
void advance(World& world, Scheme scheme, double dt, long steps, double time);

}  // namespace sprung
