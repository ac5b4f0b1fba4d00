#pragma once
#include "core/mesh/repair/weld.h"
#include "core/simulation/shapes.h"
#include "core/world/world.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// An actor of full bricks whose outer faces touch.
inline Actor touching_box(const Eigen::Vector3i& counts, double brick_size, const Material& material,
                          const Vec3& position) {
  Actor actor{
      .body = make_body(make_box_grid(counts, brick_size), Model::kCalibrated, material), .contacts = {}, .pinned = {}};
  const SurfaceMesh surface = surface_of(actor.body.grid);
  actor.contacts = embed(actor.body.grid, surface.positions);
  actor.contact_triangles = surface.triangles;
  place(actor.body, Mat3::Identity(), position);
  return actor;
}

}  // namespace sprung::test
