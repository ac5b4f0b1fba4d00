#pragma once
#include <functional>

#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/observer.h"
#include "core/simulation/recorder.h"
#include "core/world/world.h"

namespace sprung {

/// Finds the equilibrium of a body under loads (forces of as many rows as it has nodes, and pressures) with its fixed
/// nodes displaced from rest by `movements` (m x 3, m; ignored for other nodes); with `linear`, for small
/// displacements. Pressures follow the skin, with `linear` that at rest. Returns the reactions of the supports (m x 3,
/// N). `between` is called before each of Newton's iterations and may throw. Throws Error(kDiverged), Error(kBadInput)
/// if the pins leave it free, Error(kFailed) if reactions and loads do not balance to a millionth.
Points settle(SoftBody& body, const Supports& supports, const Loads& loads, const Points& movements, bool linear,
              LinearSolver& solver, int& newton_steps, const std::function<void()>& between);

/// Gravity and the pins' movements grow linearly from frame to frame; each frame is the bodies' equilibrium, for small
/// displacements where the solver is linear. Throws Error(kDiverged), Error(kBadInput), Interrupted.
[[nodiscard]] Recording record_equilibria(Simulation& simulation, const Scene& scene, const Observer& observer,
                                          RunCache* cache);

/// The lowest vibration modes of the one body, one after the other over the film, each for one period, with an
/// amplitude of a tenth of the body's size. Throws Error(kBadInput), Error(kFailed).
[[nodiscard]] Recording record_modes(Simulation& simulation, const Scene& scene, const Observer& observer,
                                     RunCache* cache);

/// Warns of each body with inverted bricks, by its own weight, an impact or its pins: its shape is then not what the
/// material would do.
void warn_of_inverted_bricks(const World& world, const Observer& observer);

}  // namespace sprung
