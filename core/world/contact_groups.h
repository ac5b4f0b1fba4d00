#pragma once
#include <cstddef>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Rows of world.actors that may come to touch each other within `time` (s), group by group, each ascending: as far as
/// their momentum, the speeds of their nodes about it, and gravity lead them.
[[nodiscard]] std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time);

}  // namespace sprung
