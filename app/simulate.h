#pragma once
#include "app/console.h"
#include "app/recording.h"

namespace sprung {

/// Takes a production through its scene in the way that scene.solver says, and says how far it is and what came out.
/// Deterministic for any number of threads.
/// Throws Error(kDiverged), Error(kBadInput) where the pins leave a body free that should come to rest, Interrupted.
[[nodiscard]] Recording simulate(Production& production, const Scene& scene, const Console& console);

}  // namespace sprung
