#include "app/start_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/units.h"
#include "core/contact/broad_phase.h"
#include "core/contact/penetration.h"
#include "core/error.h"

namespace sprung {
namespace {

std::string allowance(const Actor& actor) {
  return fmt::format("may overlap it by one brick ({}) at most",
                     readable(actor.body.grid.brick_size, Dimension::kLength));
}

void check_obstacle(const Scene& scene, const Production& production, std::size_t actor, std::size_t row) {
  const Obstacle& obstacle = production.world.obstacles[row];
  const Actor& body = production.world.actors[actor];
  const double depth = penetration_depth(obstacle, body);
  if (depth <= body.body.grid.brick_size) return;
  const std::size_t index = production.origins[actor].body;
  const std::string deep = readable(depth, Dimension::kLength);
  const std::optional<double> ground = ground_height(obstacle);
  if (!ground) {
    throw Error(ErrorKind::kBadInput, fmt::format("body {} starts {} inside obstacle {}; a body {}: move one of them",
                                                  index + 1, deep, row + 1, allowance(body)));
  }
  const double y = scene.bodies[index].position.y();
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("body {} starts {} below the ground (y = {:.6g} m); a body {}: raise its position from y = "
                  "{:.6g} m to {:.6g} m or lower the ground",
                  index + 1, deep, *ground, allowance(body), y, std::abs(y + depth) < 1e-9 * depth ? 0 : y + depth));
}

void check_pair(const Production& production, std::size_t a, std::size_t b) {
  const Actor& one = production.world.actors[a];
  const Actor& other = production.world.actors[b];
  const double depth = penetration_depth(other, one);
  const double allowed = std::min(one.body.grid.brick_size, other.body.grid.brick_size);
  if (depth <= allowed) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("body {} starts {} inside body {}; bodies may overlap by one brick ({}) at most: move them "
                          "apart, or let bodies not touch each other ([contact] bodies = false)",
                          production.origins[a].body + 1, readable(depth, Dimension::kLength),
                          production.origins[b].body + 1, readable(allowed, Dimension::kLength)));
}

}  // namespace

void check_start(const Scene& scene, const Production& production) {
  const World& world = production.world;
  std::vector<AlignedBox> boxes;
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    boxes.push_back(box_around(world.actors[i].body.positions));
    for (std::size_t row = 0; row < world.obstacles.size(); ++row) check_obstacle(scene, production, i, row);
  }
  if (!world.bodies_collide) return;
  for (const auto& [a, b] : overlapping_boxes(boxes)) {
    check_pair(production, a, b);
    check_pair(production, b, a);
  }
}

}  // namespace sprung
