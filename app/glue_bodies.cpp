#include "app/glue_bodies.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/units.h"
#include "core/contact/glue.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kNear = 0.5;  // of the smaller bricks

std::vector<std::size_t> actors_of(const Production& production, int body) {
  std::vector<std::size_t> actors;
  for (std::size_t i = 0; i < production.origins.size(); ++i) {
    if (production.origins[i].body + 1 == std::size_t(body)) actors.push_back(i);
  }
  return actors;
}

}  // namespace

void glue_bodies(const Scene& scene, std::size_t row, Production& production) {
  const SceneGlue& glue = scene.glue[row];
  World& world = production.world;
  double distance = 0;
  const std::size_t before = world.glue.size();
  for (const std::size_t a : actors_of(production, glue.bodies[0])) {
    for (const std::size_t b : actors_of(production, glue.bodies[1])) {
      if (glue.bodies[0] == glue.bodies[1] && b <= a) continue;
      const double brick = std::min(world.actors[a].body.grid.brick_size, world.actors[b].body.grid.brick_size);
      distance = glue.distance.value_or(kNear * brick);
      const std::vector<GluedPoint> points = glue_between(world, a, b, distance);
      world.glue.insert(world.glue.end(), points.begin(), points.end());
    }
  }
  if (world.glue.size() > before) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("glue {}: bodies {} and {} are nowhere within {} of each other; move them together or give "
                          "the glue a larger distance",
                          row + 1, glue.bodies[0], glue.bodies[1], readable(distance, Dimension::kLength)));
}

}  // namespace sprung
