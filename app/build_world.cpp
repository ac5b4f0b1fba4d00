#include "app/build_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/body_builder.h"
#include "app/units.h"
#include "core/error.h"
#include "core/world/squeeze.h"

namespace sprung {
namespace {

/// A body may start a little too deep, and is then lifted gently; deeper it would be shot out of the ground.
/// Throws Error(kBadInput). Nodes that are held are not in the ground's way.
void check_ground(const Actor& actor, std::size_t index, const SceneBody& scene_body, double height) {
  std::vector<bool> is_held(static_cast<std::size_t>(actor.body.node_count()));
  for (const HeldNode& held : actor.pinned) is_held[static_cast<std::size_t>(held.node)] = true;
  const Points points = deform_points(actor.body.grid, actor.contacts, actor.body.positions);
  double lowest = height;
  for (int point = 0; point < points.rows(); ++point) {
    const auto& nodes =
        actor.body.grid.nodes[static_cast<std::size_t>(actor.contacts.brick[static_cast<std::size_t>(point)])];
    const bool is_free =
        std::any_of(nodes.begin(), nodes.end(), [&](int node) { return !is_held[static_cast<std::size_t>(node)]; });
    if (is_free) lowest = std::min(lowest, points(point, 1));
  }
  const double depth = height - lowest;
  if (depth <= actor.body.grid.brick_size) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("body {} starts {} below the ground (y = {:.6g} m); a body may overlap it by one brick ({}) at "
                  "most: raise its position from y = {:.6g} m to {:.6g} m or lower the ground",
                  index + 1, readable(depth, Dimension::kLength), height,
                  readable(actor.body.grid.brick_size, Dimension::kLength), scene_body.position.y(),
                  std::abs(scene_body.position.y() + depth) < 1e-9 * depth ? 0 : scene_body.position.y() + depth));
}

}  // namespace

Production build_world(const Scene& scene, const std::vector<LoadedBody>& bodies, const Console& console) {
  Production production;
  production.world.gravity = scene.gravity;
  if (!scene.obstacles.empty()) {
    const Obstacle& ground = scene.obstacles.front();
    production.world.ground =
        Ground{.height = ground.plane.y, .friction = ground.friction, .restitution = ground.restitution};
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyBuilder builder(scene, i, bodies[i], production);
    builder.add_solids();
    builder.tell(console);
    production.size = std::max(production.size, bodies[i].extent.maxCoeff());
  }
  if (!is_motion(scene) || !production.world.ground) return production;
  for (std::size_t i = 0; i < production.world.actors.size(); ++i) {
    const std::size_t body = production.origins[i].body;
    brace(production.world.actors[i].body, scene.gravity.norm(), production.world.ground->height);
    check_ground(production.world.actors[i], body, scene.bodies[body], production.world.ground->height);
  }
  return production;
}

Points skin_positions(const Production& production, std::size_t actor, const Points& nodes) {
  return deform_points(production.world.actors[actor].body.grid, production.skins[actor].embedding, nodes);
}

}  // namespace sprung
