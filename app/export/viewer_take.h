#pragma once
#include <span>
#include <vector>

#include "app/export/animation_formats.h"
#include "app/export/viewer.h"

namespace sprung {

/// These frames of each film, as far as it has them, with its obstacles, and with displacement, speed, strain, stress,
/// and the field that its scene is coloured by, each with one range for all films. Throws Interrupted.
[[nodiscard]] std::vector<ViewerTake> viewer_takes(std::span<const CachedFilmView> views, const FrameRange& range);

}  // namespace sprung
