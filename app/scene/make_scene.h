#pragma once
#include "app/commands/command_line.h"

namespace sprung {

/// The scene of a command line: options before scene file before defaults. Throws Error(kUsage) naming the option
/// whose value is wrong, Error(kBadInput) for what is wrong in the scene file and for an unknown material.
[[nodiscard]] Film make_scene(const SceneOptions& options);

}  // namespace sprung
