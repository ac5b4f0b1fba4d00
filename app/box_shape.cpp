#include "app/box_shape.h"

#include <fmt/format.h>

#include <cmath>

#include "core/bricks/brick_grid.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kWhole = 1e-6;  // bricks that a side may lack to a whole number
constexpr double kMostBricks = 1e8;

Eigen::Vector3i brick_counts(const Vec3& sides, double brick_size) {
  const Eigen::Array3d counts = sides.array() / brick_size;
  if (counts.prod() > kMostBricks) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a box of {:.3g} bricks is too much; use larger bricks", counts.prod()));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(counts[axis] - std::round(counts[axis])) < kWhole && counts[axis] > 0.5) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("a box {:.6g} x {:.6g} x {:.6g} m does not consist of bricks of {:.6g} m: choose bricks "
                            "that fit into every side",
                            sides.x(), sides.y(), sides.z(), brick_size));
  }
  return counts.round().cast<int>();
}

}  // namespace

BrickGrid box_grid(const Vec3& sides, double brick_size) {
  BrickGrid grid = make_box_grid(brick_counts(sides, brick_size), brick_size);
  grid.origin = -sides / 2;
  return grid;
}

SurfaceMesh surface_of(const BrickGrid& grid) {
  std::vector<Eigen::Vector3i> triangles;
  for (const BrickFace& face : outer_faces(grid)) {
    triangles.emplace_back(face.nodes[0], face.nodes[1], face.nodes[2]);
    triangles.emplace_back(face.nodes[0], face.nodes[2], face.nodes[3]);
  }
  SurfaceMesh mesh;
  mesh.positions = grid.rest_positions();
  mesh.triangles.resize(triangles.size(), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesh.triangles.row(i) = triangles[i].transpose();
  }
  mesh.parts = {Part{.name = "box", .triangle_count = isize(triangles)}};
  return mesh;
}

}  // namespace sprung
