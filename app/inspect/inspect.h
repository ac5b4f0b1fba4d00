#pragma once
#include <filesystem>

#include "app/command_line.h"
#include "app/console.h"

namespace sprung {

/// `sprung inspect`: what a mesh, a scene or a cache is and what its film will take, to stdout. Throws Error.
void run_inspect(const SceneOptions& options, const Console& console);

}  // namespace sprung
