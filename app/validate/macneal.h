#pragma once
#include "core/simulation/scene.h"

namespace sprung {

/// Two beams of MacNeal and Harder, "A Proposed Standard Set of Problems to Test Finite Element Accuracy", Finite
/// Elements in Analysis and Design 1 (1985), in its units, clamped at the root; a unit force along `axis` at the end,
/// where the probe is.

/// A quarter of a ring, of radius 4.12 to 4.32 and thickness 0.1; three bricks through that.
[[nodiscard]] Scene curved_beam_scene(int axis);

/// 12 x 1.1 x 0.32, twisted by 90 degrees; so many bricks to its width.
[[nodiscard]] Scene twisted_beam_scene(int axis, int bricks);

}  // namespace sprung
