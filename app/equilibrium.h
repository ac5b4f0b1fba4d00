#pragma once
#include "app/console.h"
#include "app/recording.h"

namespace sprung {

/// Gravity and the pins' movements grow evenly from frame to frame; in each the bodies are in equilibrium, or in their
/// small displacements where the solver is linear. Throws Error(kDiverged), Error(kBadInput), Interrupted.
[[nodiscard]] Recording record_equilibria(Production& production, const Scene& scene, const Console& console,
                                          RunCache* cache);

/// The slowest natural vibrations of the one body, one after the other through the film, each swinging once, a tenth
/// of the body's size at most. Throws Error(kBadInput), Error(kFailed).
[[nodiscard]] Recording record_modes(Production& production, const Scene& scene, const Console& console,
                                     RunCache* cache);

}  // namespace sprung
