#pragma once
#include "core/simulation/observer.h"
#include "core/simulation/recorder.h"

namespace sprung {

/// Takes a simulation through its scene in the way that scene.solver says, and says how far it is and what came out.
/// With a cache every frame goes there as soon as it is done, an interrupt waits for that, and frames that the cache
/// has from an earlier run are taken up; the recording then has no frames of its own. Deterministic for any number of
/// threads, and however often it was taken up.
/// Throws Error(kDiverged), Error(kBadInput) where the pins leave a body free that should come to rest, Interrupted.
[[nodiscard]] Recording simulate(Simulation& simulation, const Scene& scene, const Observer& observer,
                                 RunCache* cache = nullptr);

}  // namespace sprung
