#include "core/motion/why_not_implicit.h"

#include <fmt/format.h>

namespace sprung {

std::string why_not_implicit(const World& world) {
  if (!world.glue.empty()) return "bodies are glued together";
  if (world.bodies_touch && world.actors.size() > 1) return "bodies touch each other";
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.restitution > 0) return fmt::format("an obstacle has a restitution of {:.3g}", obstacle.restitution);
  }
  return "";
}

}  // namespace sprung
