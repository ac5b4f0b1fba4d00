#include "app/placed_loads.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace sprung {
namespace {

/// Per node, m^3.
Eigen::VectorXd volumes_of(const std::vector<int>& bricks, const BrickGrid& grid) {
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(grid.node_count());
  for (const int brick : bricks) {
    const std::size_t row = brick;
    for (const int node : grid.nodes[row]) volumes[node] += grid.fill[row] * grid.brick_volume() / 8;
  }
  return volumes;
}

/// Of the triangles that touch, in the frame of the grid.
Points middles_of_triangles(const Actor& actor) {
  const BrickGrid& grid = actor.body.grid;
  const Points places = deform_points(grid, actor.contacts, grid.rest_positions());
  Points middles(actor.contact_triangles.rows(), 3);
  for (int row = 0; row < middles.rows(); ++row) {
    middles.row(row) = places(actor.contact_triangles.row(row), Eigen::all).colwise().mean();
  }
  return middles;
}

}  // namespace

std::vector<ForcedPart> place_forces(const std::vector<BodyForce>& forces, const Selector& selector, const Actor& actor,
                                     std::size_t solid) {
  std::vector<ForcedPart> parts;
  for (std::size_t force = 0; force < forces.size(); ++force) {
    ForcedPart part{.force = force, .volumes = {}, .triangles = {}};
    if (forces[force].pressure) {
      part.triangles = selector.triangles(forces[force], middles_of_triangles(actor), solid);
      if (part.triangles.empty()) continue;
    } else {
      part.volumes = volumes_of(selector.bricks(forces[force], actor.body.grid, solid), actor.body.grid);
      if (part.volumes.isZero(0)) continue;
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<MusclePart> place_muscles(const std::vector<BodyMuscle>& muscles, const Selector& selector,
                                      const Actor& actor, std::size_t solid, const Mat3& bricks_from_rest) {
  std::vector<MusclePart> parts;
  for (std::size_t muscle = 0; muscle < muscles.size(); ++muscle) {
    std::vector<int> bricks = selector.bricks(muscles[muscle], actor.body.grid, solid);
    if (bricks.empty()) continue;
    parts.push_back({.muscle = muscle,
                     .full = {.bricks = std::move(bricks),
                              .direction = bricks_from_rest * muscles[muscle].direction.normalized(),
                              .contraction = muscles[muscle].contraction}});
  }
  return parts;
}

void check_loads(const Scene& scene, std::size_t body, const std::vector<Origin>& origins) {
  std::vector<bool> pushed(scene.bodies[body].forces.size());
  std::vector<bool> pulled(scene.bodies[body].muscles.size());
  for (const Origin& origin : origins) {
    if (origin.body != body) continue;
    for (const ForcedPart& part : origin.forces) pushed[part.force] = true;
    for (const MusclePart& part : origin.muscles) pulled[part.muscle] = true;
  }
  const auto check = [&](const std::vector<bool>& reached, std::string_view what) {
    const auto missed = std::find(reached.begin(), reached.end(), false);
    if (missed == reached.end()) return;
    throw Error(ErrorKind::kBadInput,
                fmt::format("body {}: its {} {} reaches no brick and no triangle; make the part it chooses at least "
                            "a brick large",
                            body + 1, what, missed - reached.begin() + 1));
  };
  check(pushed, "force");
  check(pulled, "muscle");
}

}  // namespace sprung
