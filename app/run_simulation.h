#pragma once
#include "app/command_line.h"
#include "app/console.h"

namespace sprung {

/// From a mesh or a scene to a cache of its frames and to the measurements of its probes: probes.csv and probes.json in
/// the output folder; the state hash and what the probes saw last go to stdout. Throws Error, Interrupted.
void run_simulation(const SceneOptions& options, const Console& console);

}  // namespace sprung
