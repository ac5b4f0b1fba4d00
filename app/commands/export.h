#pragma once
#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// `sprung export`: frames of a cache, or of a scene that is simulated for it, as meshes; the names as typed go to
/// stdout. Throws Error, Interrupted.
void export_run(const SceneOptions& options, const Console& console);

}  // namespace sprung
