#pragma once
#include <utility>
#include <vector>

#include "core/world/touch.h"

namespace sprung {

/// Pairs of a group's actors whose skins may be within `margin` (m) of each other, where bodies touch; those of one
/// that touches itself twice the same. In a fixed order.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> near_skins(const World& world, const Group& group,
                                                                          double margin);

/// s: `dt`, or as long as no two surfaces that are near each other get closer by more than half a brick: what moves
/// further in a step may come out on the other side.
[[nodiscard]] double longest_stride(const World& world, const Group& group, double dt);

}  // namespace sprung
