#pragma once
#include "core/mesh/repair/weld.h"
#include "core/simulation/shapes.h"
#include "core/world/world.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// A body of full bricks whose outer faces touch.
inline SoftBody touching_box(const Eigen::Vector3i& counts, double brick_size, const Material& material,
                             const Vec3& position) {
  SoftBody body(make_body(make_box_grid(counts, brick_size), Model::kCalibrated, material));
  const SurfaceMesh surface = surface_of(body.grid);
  body.contact.points = embed(body.grid, surface.positions);
  body.contact.triangles = surface.triangles;
  place(body, Mat3::Identity(), position);
  return body;
}

}  // namespace sprung::test
