#pragma once
#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// From a mesh or a scene to pictures and films; the outputs' names go to stdout. Throws Error, Interrupted.
void animate(const SceneOptions& options, const Console& console);

}  // namespace sprung
