#pragma once
#include "app/command_line.h"

namespace sprung {

/// `sprung inspect RUN.h5`: what a cache holds, to stdout. Throws Error.
void inspect_cache(const SceneOptions& options);

}  // namespace sprung
