#include "app/build_world.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <exception>

#include "app/body_builder.h"
#include "app/glue_bodies.h"
#include "app/placed_loads.h"
#include "app/start_checks.h"
#include "core/contact/inversion_guard.h"

namespace sprung {
namespace {

constexpr double kDrawnPlane = 4;  // sizes of the largest body: half the side of what is drawn of a plane

/// All bodies at the same time. What stops one is kept, so that the first body in the scene that fails is told of.
std::vector<std::exception_ptr> fill_bodies(std::deque<BodyBuilder>& builders) {
  std::vector<std::exception_ptr> failures(builders.size());
  tbb::parallel_for(std::size_t{0}, builders.size(), [&](std::size_t i) {
    try {
      builders[i].fill_solids();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  return failures;
}

}  // namespace

Production build_world(const Scene& scene, const std::vector<LoadedBody>& bodies, const Console& console) {
  Production production;
  production.world.gravity = scene.gravity;
  production.world.bodies_collide = scene.contact.bodies;
  std::deque<BodyBuilder> builders;
  for (std::size_t i = 0; i < bodies.size(); ++i) builders.emplace_back(scene, i, bodies[i], production);
  const std::vector<std::exception_ptr> failures = fill_bodies(builders);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (failures[i]) std::rethrow_exception(failures[i]);
    builders[i].add_solids();
    builders[i].tell(console);
    check_loads(scene, i, production.origins);
    production.size = std::max(production.size, bodies[i].extent.maxCoeff());
  }
  production.obstacles = make_obstacles(scene, kDrawnPlane * production.size, console);
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    production.world.obstacles.push_back(obstacle_between(production.obstacles[i], scene.obstacles[i], 0, 0));
  }
  if (!is_motion(scene)) return production;
  for (std::size_t i = 0; i < scene.glue.size(); ++i) glue_bodies(scene, i, production);
  const double speed = impact_speed(production.world);
  for (Actor& actor : production.world.actors) stiffen_volume_guard(actor.body, scene.gravity.norm(), speed);
  check_start(scene, production);
  return production;
}

std::vector<int> pinned_nodes(const Origin& origin) {
  std::vector<int> nodes;
  for (const PinnedNodes& pinned : origin.pins) nodes.insert(nodes.end(), pinned.nodes.begin(), pinned.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Points skin_positions(const Production& production, std::size_t actor, const Points& nodes) {
  return deform_points(production.world.actors[actor].body.grid, production.skins[actor].embedding, nodes);
}

}  // namespace sprung
