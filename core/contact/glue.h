#pragma once
#include <span>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Points where the skin of one body lies within `distance` (m) of another's, one at each corner of the bricks of the
/// body with the smaller bricks; both in their undeformed initial state. Deterministic.
[[nodiscard]] std::vector<GluedPoint> glue_between(const World& world, std::size_t a, std::size_t b, double distance);

/// Glued points that drift apart by rounding are rejoined within about this many steps.
inline constexpr double kRejoinSteps = 4;

/// The glued points among these bodies, by their rows in the list.
[[nodiscard]] std::vector<GluedPoint> glue_within(const World& world, std::span<const std::size_t> bodies);

}  // namespace sprung
