#pragma once
#include "core/simulation/observer.h"
#include "core/simulation/recorder.h"

namespace sprung {

/// Runs a simulation by scene.solver and reports its progress and results. With a cache every frame is written as soon
/// as it is computed, interrupts wait for that, and the frames of an earlier run are resumed from; the recording then
/// has no frames of its own. Deterministic for any number of threads and of interruptions. Throws Error(kDiverged),
/// Error(kBadInput) if the pins leave a body free whose equilibrium is sought, Interrupted.
[[nodiscard]] Recording simulate(Simulation& simulation, const Scene& scene, const Observer& observer,
                                 RunCache* cache = nullptr);

}  // namespace sprung
