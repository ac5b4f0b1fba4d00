#include "app/make_production.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/progress.h"
#include "app/units.h"
#include "core/count_of.h"

namespace sprung {
namespace {

std::vector<LoadedBody> load_bodies(const Scene& scene, const Console& console) {
  Progress progress(console, "read");
  std::vector<LoadedBody> bodies;
  long triangles = 0;
  long solids = 0;
  for (const SceneBody& body : scene.bodies) {
    const LoadedBody& loaded = bodies.emplace_back(load_body(body, console));
    triangles += loaded.mesh.triangles.rows();
    solids += static_cast<long>(loaded.solids.size());
  }
  progress.finish(fmt::format("{}, {}", count_of(triangles, "triangle"), count_of(solids, "solid")));
  return bodies;
}

/// "1.2 cm", or "1.1 cm to 1.2 cm" where the bodies differ.
std::string brick_sizes(const std::vector<LoadedBody>& bodies) {
  const auto by_size = [](const LoadedBody& a, const LoadedBody& b) { return a.brick_size < b.brick_size; };
  const auto [smallest, largest] = std::minmax_element(bodies.begin(), bodies.end(), by_size);
  const std::string low = readable(smallest->brick_size, Dimension::kLength);
  const std::string high = readable(largest->brick_size, Dimension::kLength);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

}  // namespace

Production make_production(const Scene& scene, const Console& console) {
  const std::vector<LoadedBody> bodies = load_bodies(scene, console);
  Progress progress(console, "bricks");
  Production production = build_world(scene, bodies, console);
  int bricks = 0;
  int nodes = 0;
  double mass = 0;
  for (const Actor& actor : production.world.actors) {
    bricks += actor.body.grid.brick_count();
    nodes += actor.body.node_count();
    mass += actor.body.masses.sum();
  }
  progress.finish(
      fmt::format("{} of {}, {} nodes, {:.4g} kg", count_of(bricks, "brick"), brick_sizes(bodies), nodes, mass));
  return production;
}

}  // namespace sprung
