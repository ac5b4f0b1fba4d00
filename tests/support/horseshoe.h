#pragma once
#include <algorithm>
#include <limits>

#include "tests/support/touching.h"

namespace sprung::test {

/// A horseshoe of bricks of that size (m), open to the top, whose arms begin to swing together.
inline SoftBody closing_horseshoe(double h) {
  BrickGrid grid;
  grid.brick_size = h;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 6; ++x) {
      if (y < 2 || x < 2 || x >= 4) grid.cells.emplace_back(x, y, 0);
    }
  }
  grid.fill.assign(grid.cells.size(), 1.0);
  number_nodes(grid);
  SoftBody body(make_body(grid, Model::kCalibrated, test_material(0.3, 2e4)));
  const SurfaceMesh surface = surface_of(body.grid);
  body.contact.points = embed(body.grid, surface.positions);
  body.contact.triangles = surface.triangles;
  for (int node = 0; node < body.node_count(); ++node) {
    const Vec3 x = body.positions.row(node);
    if (x.y() > 2 * h) body.velocities(node, 0) = (x.x() < 3 * h ? 1.0 : -1.0) * 8 * (x.y() - 2 * h);
  }
  return body;
}

/// The gap between the inner sides of its arms at their nearest nodes, m; negative if they cross.
inline double gap_of_horseshoe(const Body& body) {
  double least = std::numeric_limits<double>::infinity();
  for (int node = 0; node < body.node_count(); ++node) {
    const Eigen::Vector3i& place = body.grid.lattice[node];
    if (place.x() != 2 || place.y() < 4) continue;
    for (int other = 0; other < body.node_count(); ++other) {
      if (body.grid.lattice[other] != Eigen::Vector3i(4, place.y(), place.z())) continue;
      least = std::min(least, body.positions(other, 0) - body.positions(node, 0));
    }
  }
  return least;
}

}  // namespace sprung::test
