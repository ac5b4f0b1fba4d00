#include "app/box_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/bricks/cell_index.h"
#include "core/bricks/corner.h"
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

/// Corners of a brick's face on the low or high side of an axis, counter-clockwise seen from outside.
std::array<std::size_t, 4> face_corners(int axis, bool high) {
  const int j = 1 << ((axis + 1) % 3);
  const int k = 1 << ((axis + 2) % 3);
  const int base = high ? 1 << axis : 0;
  std::array<int, 4> loop{base, base | j, base | j | k, base | k};
  if (!high) std::swap(loop[1], loop[3]);
  return {static_cast<std::size_t>(loop[0]), static_cast<std::size_t>(loop[1]), static_cast<std::size_t>(loop[2]),
          static_cast<std::size_t>(loop[3])};
}

}  // namespace

BrickGrid box_grid(const Vec3& sides, double brick_size) {
  BrickGrid grid = make_box_grid(brick_counts(sides, brick_size), brick_size);
  grid.origin = -sides / 2;
  return grid;
}

SurfaceMesh surface_of(const BrickGrid& grid) {
  const CellIndex bricks(grid);
  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const bool high = side % 2 == 1;
      Eigen::Vector3i neighbour = grid.cells[brick];
      neighbour[axis] += high ? 1 : -1;
      if (bricks.at(neighbour) >= 0) continue;
      const auto corners = face_corners(axis, high);
      const auto node = [&](std::size_t i) { return grid.nodes[brick][corners[i]]; };
      triangles.emplace_back(node(0), node(1), node(2));
      triangles.emplace_back(node(0), node(2), node(3));
    }
  }
  SurfaceMesh mesh;
  mesh.positions = grid.rest_positions();
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles[i].transpose();
  }
  mesh.parts = {Part{.name = "box", .triangle_count = static_cast<int>(triangles.size())}};
  return mesh;
}

}  // namespace sprung
