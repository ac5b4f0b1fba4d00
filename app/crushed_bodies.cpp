#include "app/crushed_bodies.h"

#include <fmt/format.h>

#include "core/contact/inversion_guard.h"

namespace sprung {

void warn_of_crushed_bodies(const World& world, const Console& console) {
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    const Body& body = world.actors[i].body;
    const int inverted = inverted_bricks(body);
    if (inverted == 0 && !is_crushed(body)) continue;
    console.warn(fmt::format(
        "body {}: of {} bricks {} are inside out and {} pressed to less than {} of their volume at the end, where the "
        "guard against turning inside out carries them, not their springs: the material is too soft for its weight, "
        "its fall or what moves it; a stiffer or lighter material (young, density) or a smaller body carries itself",
        i + 1, body.grid.brick_count(), inverted, guarded_bricks(body) - inverted, body.law.guard_ratio));
  }
}

}  // namespace sprung
