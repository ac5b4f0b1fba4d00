#pragma once
#include "app/console.h"
#include "core/world/world.h"

namespace sprung {

/// A material that cannot carry its own weight, or a fall it cannot take, ends with bricks pressed flat: the picture is
/// then not what the material would do. A warning for each such body.
void warn_of_crushed_bodies(const World& world, const Console& console);

}  // namespace sprung
