#pragma once
#include "core/simulation/simulation.h"
#include "render/image/image.h"

namespace sprung {

/// The bodies of a scene as they start, twice side by side: on the left their skins, on the right their bricks. Bricks
/// of parts thinner than a brick are orange, those that share their cell with another piece of the solid blue, those
/// where a hole was closed purple, those that are less than half full a little darker. Throws Error(kFailed) where no
/// picture can be drawn.
[[nodiscard]] Image draw_bricks(const Preparation& prepared);

}  // namespace sprung
