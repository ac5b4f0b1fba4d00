#pragma once
#include <span>
#include <vector>

#include "core/world/world.h"

namespace sprung {

// A frame of an explicit motion, from the outside in; each level runs the ones below it:
//
//   SceneMotion            splits the frame where pins, loads or gravity change, and moves the obstacles
//     AdaptiveIntegrator     finds contact groups and their steps; checks the frame, and repeats it with half the step
//       advance()              runs the groups in parallel, a chunk of steps at a time
//         GroupStepper           kick, contact, drift: one step of one group
//           BodyStepper            springs, damping, loads, foundations and pins of one body
//           SweptContacts          contact by a few sweeps of impulses, and a guarantee

class ContactStates;

/// Largest step (s) that is stable for every body: from largest_frequency_squared() with the damping of explicit steps,
/// times `safety`. Bricks that are flattened along one axis and stretched along another are stiffer: it holds for the
/// bodies' current state.
[[nodiscard]] double stable_step(const World& world, double safety = 0.7);
[[nodiscard]] double stable_step(const Body& body, double safety = 0.7);
/// That of some bodies, by their rows.
[[nodiscard]] double stable_step(const World& world, const std::vector<std::size_t>& bodies);

/// The square of the fastest frequency (1/s^2) of any node of the body: the largest eigenvalue of a single brick with
/// its own lumped mass, which bounds the assembled one; of solid bricks (Model::kCalibrated) the assembled one itself,
/// plus a tenth.
[[nodiscard]] double largest_frequency_squared(const Body& body);

enum class Scheme { kSymplecticEuler, kVerlet };

/// Equal steps that fill a time exactly.
struct Steps {
  long count = 1;
  double dt = 0;  // s
};

/// As few as fill `time` (s) in steps no longer than `longest` (s); at least one.
[[nodiscard]] Steps equal_steps(double time, double longest);

/// Bodies that may come into contact, and the steps they take together.
struct GroupSteps {
  std::vector<std::size_t> bodies;  // rows of World::bodies
  Steps steps;
  double elapsed = 0;  // s, since obstacles had the world's poses
  double share = 1;    // of stable_step(), where bricks that are being flattened make it shorter than planned
};

/// Moves each group of bodies by its own steps, all at once: only those of one group touch each other. Obstacles keep
/// the world's poses: the caller must move them. Where bricks are being flattened, and so stiffer from step to step,
/// the steps of their group become shorter: `groups` returns their number and the shortest. Deterministic for any
/// number of threads. Throws Diverged with the body if a position is no longer finite, or a node moves by bricks
/// against its body in a step. `states`: of these groups, in this frame.
void advance(World& world, Scheme scheme, std::span<GroupSteps> groups, double time, const ContactStates& states);

/// The same with `steps` steps of `dt` seconds for all, and the search for contacts started afresh; moves the obstacles
/// too.
void advance(World& world, Scheme scheme, double dt, long steps, double time);

}  // namespace sprung
