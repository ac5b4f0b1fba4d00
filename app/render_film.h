#pragma once
#include <vector>

#include "app/output.h"
#include "app/recording.h"

namespace sprung {

/// Draws every frame of a recording and writes it to the outputs. Throws Error(kFailed), Interrupted.
void render_film(const Production& production, const Recording& recording, const Scene& scene,
                 const std::vector<Output>& outputs, const Console& console);

}  // namespace sprung
