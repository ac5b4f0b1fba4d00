#include "core/contact/search/obstacle_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/mesh/repair/weld.h"
#include "core/skin/skin.h"

namespace sprung {
namespace {

constexpr double kLongestEdge = 4;  // bricks
constexpr double kMaxAcross = 128;  // bricks along the longest side of an obstacle

constexpr int kSides = 64;  // of the prism that stands for a cylinder

SurfaceMesh box_mesh(const Vec3& half) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  SurfaceMesh mesh;
  mesh.positions.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions(corner, axis) = (corner >> axis & 1 ? 1 : -1) * half[axis];
  }
  mesh.triangles.resize(12, 3);
  for (int face = 0; face < 6; ++face) {
    const auto& [a, b, c, d] = kFaces[face];
    mesh.triangles.row(2 * face) << a, b, c;
    mesh.triangles.row(2 * face + 1) << a, c, d;
  }
  return mesh;
}

/// A prism within the cylinder.
SurfaceMesh prism_mesh(const SolidCylinder& cylinder) {
  SurfaceMesh mesh;
  mesh.positions.resize(2 * kSides + 2, 3);
  mesh.triangles.resize(4 * kSides, 3);
  for (int end = 0; end < 2; ++end) mesh.positions.row(2 * kSides + end) << 0, (2 * end - 1) * cylinder.half_length, 0;
  for (int side = 0; side < kSides; ++side) {
    const double angle = 2 * std::numbers::pi * side / kSides;
    const int next = (side + 1) % kSides;
    for (int end = 0; end < 2; ++end) {
      mesh.positions.row(2 * side + end) << cylinder.radius * std::cos(angle), (2 * end - 1) * cylinder.half_length,
          cylinder.radius * std::sin(angle);
    }
    mesh.triangles.row(4 * side) << 2 * side, 2 * side + 1, 2 * next + 1;
    mesh.triangles.row(4 * side + 1) << 2 * side, 2 * next + 1, 2 * next;
    mesh.triangles.row(4 * side + 2) << 2 * kSides, 2 * side, 2 * next;
    mesh.triangles.row(4 * side + 3) << 2 * kSides + 1, 2 * next + 1, 2 * side + 1;
  }
  return mesh;
}

SurfaceMesh mesh_of(const Shape& shape) {
  if (const auto* box = std::get_if<SolidBox>(&shape)) return box_mesh(box->half);
  if (const auto* cylinder = std::get_if<SolidCylinder>(&shape)) return prism_mesh(*cylinder);
  const MeshDistance& solid = *std::get<MeshSolid>(shape).distance;
  SurfaceMesh mesh;
  mesh.positions = solid.positions();
  mesh.triangles = solid.triangles();
  return mesh;
}

}  // namespace

bool has_edges(const Shape& shape) {
  return std::holds_alternative<SolidBox>(shape) || std::holds_alternative<SolidCylinder>(shape) ||
         std::holds_alternative<MeshSolid>(shape);
}

SoftBody obstacle_surface(const Obstacle& obstacle, double brick_size) {
  SurfaceMesh mesh = mesh_of(obstacle.shape);
  mesh.parts = {{.name = "", .first_triangle = 0, .triangle_count = int(mesh.triangles.rows())}};
  const Vec3 low = mesh.positions.colwise().minCoeff();
  const double extent = (mesh.positions.rowwise() - low.transpose()).maxCoeff();
  const Skin skin = make_skin(mesh, {.max_edge = std::max(kLongestEdge * brick_size, extent / kMaxAcross)});

  SoftBody surface;
  BrickGrid& grid = surface.grid;
  grid.brick_size = std::max(brick_size, extent / kMaxAcross);
  grid.origin = low;
  const std::vector<int> point_of = weld_points(skin.positions);
  const auto cell_of = [&](Eigen::Index row) -> Eigen::Vector3i {
    return ((skin.positions.row(row).transpose() - low) / grid.brick_size).array().floor().cast<int>();
  };
  const auto before = [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return std::tuple(a.z(), a.y(), a.x()) < std::tuple(b.z(), b.y(), b.x());
  };
  for (Eigen::Index row = 0; row < skin.positions.rows(); ++row) grid.cells.push_back(cell_of(row));
  std::sort(grid.cells.begin(), grid.cells.end(), before);
  grid.cells.erase(std::unique(grid.cells.begin(), grid.cells.end()), grid.cells.end());
  grid.fill.assign(grid.cells.size(), 1);
  number_nodes(grid);

  Embedding& points = surface.contact.points;
  points.local.resize(skin.positions.rows(), 3);
  for (Eigen::Index row = 0; row < skin.positions.rows(); ++row) {
    const Eigen::Vector3i cell = cell_of(row);
    const auto place = std::lower_bound(grid.cells.begin(), grid.cells.end(), cell, before);
    points.brick.push_back(int(place - grid.cells.begin()));
    points.local.row(row) =
        (skin.positions.row(row) - low.transpose()) / grid.brick_size - cell.cast<double>().transpose();
  }
  surface.contact.triangles = skin.triangles.unaryExpr([&](int vertex) { return point_of[vertex]; });
  surface.rest_positions = grid.rest_positions();
  surface.positions = surface.rest_positions;
  surface.velocities = Points::Zero(grid.node_count(), 3);
  surface.contact.with_itself = false;
  return surface;
}

void move_surface(const Obstacle& obstacle, double elapsed, double dt, SoftBody& surface) {
  const auto at = [&](double time) -> Points {
    const Pose pose = pose_after(obstacle, time);
    return surface.rest_positions.lazyProduct(pose.rotation.transpose()).rowwise() + pose.translation.transpose();
  };
  surface.positions = at(elapsed);
  if (obstacle.is_moving()) {
    surface.velocities = (at(elapsed + dt) - surface.positions) / dt;
  } else {
    surface.velocities.setZero();
  }
}

}  // namespace sprung
