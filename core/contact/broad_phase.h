#pragma once
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/contact/search/group.h"
#include "core/types.h"
#include "core/world/world.h"

namespace sprung {

/// The box enlarged by `by` on every side.
[[nodiscard]] AlignedBox widened(const AlignedBox& box, double by);

/// Rows i < j of boxes that overlap and for which `is_kept` holds, in a fixed order. A grid with cells as large as the
/// largest box: fast if boxes have similar sizes. Throws nothing; boxes that are not finite overlap nothing.
[[nodiscard]] std::vector<std::pair<int, int>> overlapping_boxes(
    const std::vector<AlignedBox>& boxes, const std::function<bool(int, int)>& is_kept = [](int, int) { return true; });

/// Pairs of a group's bodies whose skins may be within `margin` (m) of each other, if bodies collide; a body that
/// collides with itself is paired with itself. In a fixed order.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> broad_phase(const World& world, const Group& group,
                                                                           double margin);

/// The step, s: `dt`, or shorter so that no two nearby surfaces approach by more than half a brick: what moves further
/// in a step may pass through.
[[nodiscard]] double max_step_size(const World& world, const Group& group, double dt);

/// Rows of world.bodies that may come into contact within `time` (s), group by group, each ascending: judged by their
/// momentum, the speeds of their nodes relative to it, and gravity.
[[nodiscard]] std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time);

}  // namespace sprung
