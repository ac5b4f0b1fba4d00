#include "core/motion/why_not_implicit.h"

#include <fmt/format.h>

namespace sprung {

std::string why_not_implicit(const World& world) {
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.restitution > 0) return fmt::format("an obstacle has a restitution of {:.3g}", obstacle.restitution);
  }
  return "";
}

}  // namespace sprung
