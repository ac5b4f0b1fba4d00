#include "core/simulation/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/brick_topology.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kWhole = 1e-6;  // tolerance of a whole number of bricks
constexpr double kMaxBricks = 1e8;

Eigen::Vector3i brick_counts(const Vec3& sides, double brick_size) {
  const Eigen::Array3d counts = sides.array() / brick_size;
  if (counts.prod() > kMaxBricks) {
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

namespace {

constexpr int kAround = 96;  // corners of a circle

/// A point of the profile of a surface of revolution about the y axis.
struct ProfilePoint {
  Eigen::Vector2d position;  // m; distance from the axis, height
  Eigen::Vector2d normal;    // outward, unit
};

/// Point `i` of a full circle in `count` parts; exact at its quarters.
Eigen::Vector2d on_circle(int step, int count) {
  const auto cosine = [&](int k) {
    k = ((k % count) + count) % count;
    if (4 * k == count || 4 * k == 3 * count) return 0.0;
    return std::cos(2 * std::numbers::pi * k / count);
  };
  return {cosine(step), cosine(step - count / 4)};
}

/// A circle at each point of the profile (outside on its right, going up), and triangles between consecutive ones,
/// except for creases: those coincide.
SurfaceMesh revolve(const std::vector<ProfilePoint>& profile, const std::string& name) {
  const auto rings = isize(profile);
  SurfaceMesh mesh;
  mesh.positions.resize(rings * kAround, 3);
  mesh.normals.resize(rings * kAround, 3);
  for (int ring = 0; ring < rings; ++ring) {
    const auto& [place, normal] = profile[ring];
    for (int k = 0; k < kAround; ++k) {
      const Eigen::Vector2d around = on_circle(k, kAround);
      mesh.positions.row(ring * kAround + k) << place.x() * around.x(), place.y(), place.x() * around.y();
      const Eigen::RowVector3d outward(normal.x() * around.x(), normal.y(), normal.x() * around.y());
      mesh.normals.row(ring * kAround + k) = outward.cast<float>();
    }
  }
  std::vector<Eigen::RowVector3i> triangles;
  for (int ring = 0; ring + 1 < rings; ++ring) {
    const Eigen::Vector2d& low = profile[ring].position;
    const Eigen::Vector2d& high = profile[ring + 1].position;
    if (low == high) continue;
    for (int k = 0; k < kAround; ++k) {
      const int here = ring * kAround + k;
      const int beside = ring * kAround + (k + 1) % kAround;
      if (high.x() > 0) triangles.emplace_back(here, here + kAround, beside + kAround);
      if (low.x() > 0) triangles.emplace_back(here, beside + kAround, beside);
    }
  }
  mesh.triangles.resize(triangles.size(), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) mesh.triangles.row(i) = triangles[i];
  mesh.parts = {Part{.name = name, .triangle_count = isize(triangles)}};
  return mesh;
}

}  // namespace

SurfaceMesh mesh_of(const SphereShape& sphere) {
  std::vector<ProfilePoint> profile;
  for (int step = -kAround / 4; step <= kAround / 4; ++step) {
    const Eigen::Vector2d outward = on_circle(step, kAround);
    profile.push_back({.position = sphere.radius * outward, .normal = outward});
  }
  return revolve(profile, "sphere");
}

SurfaceMesh mesh_of(const CylinderShape& cylinder) {
  const double radius = cylinder.radius;
  const double high = cylinder.height / 2;
  return revolve({{{0, -high}, {0, -1}},
                  {{radius, -high}, {0, -1}},
                  {{radius, -high}, {1, 0}},
                  {{radius, high}, {1, 0}},
                  {{radius, high}, {0, 1}},
                  {{0, high}, {0, 1}}},
                 "cylinder");
}

SurfaceMesh mesh_of(const TorusShape& torus) {
  constexpr int kAlong = kAround / 2;
  std::vector<ProfilePoint> profile;
  for (int step = 0; step <= kAlong; ++step) {
    const Eigen::Vector2d outward = on_circle(step, kAlong);
    profile.push_back({.position = Eigen::Vector2d(torus.radius, 0) + torus.tube * outward, .normal = outward});
  }
  return revolve(profile, "torus");
}

SurfaceMesh mesh_of(const CapsuleShape& capsule) {
  std::vector<ProfilePoint> profile;
  for (const double end : {-0.5, 0.5}) {
    const int first = end < 0 ? -kAround / 4 : 0;
    for (int step = first; step <= first + kAround / 4; ++step) {
      const Eigen::Vector2d outward = on_circle(step, kAround);
      profile.push_back(
          {.position = capsule.radius * outward + Eigen::Vector2d(0, end * capsule.height), .normal = outward});
    }
  }
  return revolve(profile, "capsule");
}

SurfaceMesh box_mesh(const Vec3& sides) {
  SurfaceMesh mesh;
  mesh.positions.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      mesh.positions(corner, axis) = (on_high_side(corner, axis) ? 0.5 : -0.5) * sides[axis];
    }
  }
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5,
      3, 7, 5;
  mesh.parts = {Part{.name = "box", .triangle_count = 12}};
  return mesh;
}

}  // namespace sprung
