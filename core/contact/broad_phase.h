#pragma once
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/contact/contacts.h"
#include "core/types.h"
#include "core/world/world.h"

namespace sprung {

/// Larger by so much on every side.
[[nodiscard]] AlignedBox widened(const AlignedBox& box, double by);

/// Rows i < j of boxes that overlap and that `is_kept`, in a fixed order. A grid with cells as large as the largest
/// box: quick where boxes are of about one size. Throws nothing; boxes that are not finite overlap nothing.
[[nodiscard]] std::vector<std::pair<int, int>> overlapping_boxes(
    const std::vector<AlignedBox>& boxes, const std::function<bool(int, int)>& is_kept = [](int, int) { return true; });

/// Pairs of a group's bodies whose skins may be within `margin` (m) of each other, where bodies touch; those of one
/// that touches itself twice the same. In a fixed order.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> broad_phase(const World& world, const Group& group,
                                                                           double margin);

/// s: `dt`, or as long as no two surfaces that are near each other get closer by more than half a brick: what moves
/// further in a step may come out on the other side.
[[nodiscard]] double max_step_size(const World& world, const Group& group, double dt);

/// Rows of world.bodies that may come to touch each other within `time` (s), group by group, each ascending: as far as
/// their momentum, the speeds of their nodes about it, and gravity lead them.
[[nodiscard]] std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time);

}  // namespace sprung
