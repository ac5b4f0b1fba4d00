#pragma once
#include "core/body/body.h"
#include "core/body/brick_tiles.h"

namespace sprung {

/// Of a body's full brick.
[[nodiscard]] SolidLaw solid_law(const Material& material, double h);

/// Of a body with model kNeoHooke. Cost: linear in the bricks.
[[nodiscard]] BrickTiles make_solid_tiles(const Body& body);

}  // namespace sprung
