#pragma once
#include <filesystem>

#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// `sprung inspect`: what a mesh, a scene or a cache is and what its film will take, to stdout. Throws Error.
void run_inspect(const SceneOptions& options, const Console& console);

/// `sprung inspect RUN.h5`: what a cache holds, to stdout. Throws Error.
void inspect_cache(const SceneOptions& options);

}  // namespace sprung
