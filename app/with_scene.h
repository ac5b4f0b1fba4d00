#pragma once
#include <functional>

#include "app/command_line.h"

namespace sprung {

/// What the commands that take a scene have in common: finds the scene that the options mean and does `work` with it
/// on as many threads as they say; or prints the scene where that is all that was asked for. Throws Error.
void with_scene(const SceneOptions& options, const std::function<void(const Scene&)>& work);

}  // namespace sprung
