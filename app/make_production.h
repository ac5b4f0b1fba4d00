#pragma once
#include "app/build_world.h"

namespace sprung {

/// Reads the bodies of a scene and fills them with bricks; says what came out. Throws Error(kBadInput).
[[nodiscard]] Production make_production(const Scene& scene, const Console& console);

}  // namespace sprung
