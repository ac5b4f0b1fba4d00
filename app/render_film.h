#pragma once
#include <vector>

#include "app/frame_range.h"
#include "app/output.h"
#include "app/recording.h"

namespace sprung {

/// Draws these frames of a recording and writes them to the outputs. A picture depends on its frame and on the whole
/// recording, which the camera has in view, but not on which others are drawn. Throws Error(kFailed), Interrupted.
void render_film(const Production& production, const Recording& recording, const Scene& scene, const FrameRange& range,
                 const std::vector<Output>& outputs, const Console& console);

}  // namespace sprung
