#pragma once
#include "core/world/world.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// One body, every node of which touches obstacles.
inline World world_of(Body body, const Vec3& gravity = Vec3::Zero()) {
  World world;
  SoftBody& added = world.bodies.emplace_back(std::move(body));
  added.contact.points = embed(added.grid, added.grid.rest_positions());
  world.gravity = gravity;
  return world;
}

inline Body box_body(const Eigen::Vector3i& counts, double h, Model model, double poisson) {
  return make_body(make_box_grid(counts, h), model, test_material(poisson));
}

}  // namespace sprung::test
