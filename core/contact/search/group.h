#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Bodies that may come into contact and therefore take the same steps.
using Group = std::vector<SoftBody*>;

/// Side of the smallest bricks, m.
[[nodiscard]] inline double smallest_brick(const Group& group) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SoftBody* body : group) smallest = std::min(smallest, body->grid.brick_size);
  return smallest;
}

}  // namespace sprung
