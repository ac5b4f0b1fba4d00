#pragma once
#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// `sprung render`: a range of a cache's frames to pictures or a film, by one or several processes; the outputs' names
/// go to stdout. Throws Error, Interrupted.
void render_cache(const SceneOptions& options, const Console& console);

}  // namespace sprung
