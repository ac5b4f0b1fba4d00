#pragma once
#include <string>

#include "app/commands/command_line.h"
#include "app/console/console.h"
#include "core/simulation/recorder.h"

namespace sprung {

/// From a mesh or a scene to a cache of its frames and to the measurements of its probes: probes.csv and probes.json in
/// the output folder; the state hash and what the probes saw last go to stdout. Throws Error, Interrupted.
void run_simulation(const SceneOptions& options, const Console& console);

/// One line a frame under a line of names: "time_s,tip.position.x_m,...,end.torque.z_Nm".
[[nodiscard]] std::string probes_csv(const Recording& recording);

/// The same by probe, with the frequencies of modes and the state hash.
[[nodiscard]] std::string probes_json(const Recording& recording);

/// How a run came about, as JSON: version and build of the program, the scene as resolved, a hash of each mesh file it
/// names and of the state in the last frame, and how long each frame took (s, wall clock; those of an earlier run that
/// this one went on from included).
[[nodiscard]] std::string manifest_json(const Film& scene, const Recording& recording);

}  // namespace sprung
