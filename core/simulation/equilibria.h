#pragma once
#include "core/dynamics/linear/linear_solver.h"
#include "core/simulation/observer.h"
#include "core/simulation/recorder.h"
#include "core/world/world.h"

namespace sprung {

/// Brings a body to rest under loads (m x 3, N), the nodes that it holds moved from their rest by `movements` (m x 3,
/// m; those of other nodes are not read); with `linear`, for small displacements. Returns the forces that hold those
/// nodes (m x 3, N). Throws Error(kDiverged), Error(kBadInput) where they leave it free.
Points settle(SoftBody& body, const Points& loads, const Points& movements, bool linear, LinearSolver& solver,
              int& newton_steps);

/// Gravity and the pins' movements grow evenly from frame to frame; in each the bodies are in equilibrium, or in their
/// small displacements where the solver is linear. Throws Error(kDiverged), Error(kBadInput), Interrupted.
[[nodiscard]] Recording record_equilibria(Simulation& simulation, const Scene& scene, const Observer& observer,
                                          RunCache* cache);

/// The slowest natural vibrations of the one body, one after the other through the film, each swinging once, a tenth
/// of the body's size at most. Throws Error(kBadInput), Error(kFailed).
[[nodiscard]] Recording record_modes(Simulation& simulation, const Scene& scene, const Observer& observer,
                                     RunCache* cache);

/// A material that cannot carry its own weight, or a fall it cannot take, ends with bricks pressed flat: the picture is
/// then not what the material would do. A warning for each such body.
void warn_of_crushed_bodies(const World& world, const Observer& observer);

}  // namespace sprung
