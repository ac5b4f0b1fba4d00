#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>
#include <string>

#include "core/io/mesh_export.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// How GoogleTest names a parameter.
inline void PrintTo(const MeshFormat& format, std::ostream* out) { *out << format.extension; }

}  // namespace sprung

namespace sprung::test {

/// How many repairs of a kind were made.
inline int count_of_kind(const Solids& found, const std::string& kind) {
  const auto repair = std::find_if(found.repairs.begin(), found.repairs.end(),
                                   [&](const Repair& candidate) { return candidate.kind == kind; });
  return repair == found.repairs.end() ? 0 : repair->count;
}

inline SurfaceMesh mesh_of(Points positions, Triangles triangles) {
  SurfaceMesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  mesh.parts.push_back({.name = "test", .triangle_count = int(mesh.triangles.rows())});
  return mesh;
}

/// A closed box, outward.
inline SurfaceMesh box_mesh(const Vec3& low, const Vec3& high) {
  Points positions(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) positions(corner, axis) = (corner >> axis & 1) != 0 ? high[axis] : low[axis];
  }
  Triangles triangles(12, 3);
  triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7,
      5;
  return mesh_of(std::move(positions), std::move(triangles));
}

/// A closed torus about the z axis, outward.
inline SurfaceMesh torus_mesh(double ring, double tube, int around = 96, int across = 48) {
  Points positions(around * across, 3);
  Triangles triangles(2 * around * across, 3);
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around;
      const double b = 2 * std::numbers::pi * j / across;
      const double r = ring + tube * std::cos(b);
      const int here = i * across + j;
      const int next_j = i * across + (j + 1) % across;
      const int next_i = (i + 1) % around * across + j;
      const int next = (i + 1) % around * across + (j + 1) % across;
      positions.row(here) = Vec3(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
      triangles.row(2 * here) = Eigen::Vector3i(here, next_i, next);
      triangles.row(2 * here + 1) = Eigen::Vector3i(here, next, next_j);
    }
  }
  return mesh_of(std::move(positions), std::move(triangles));
}

/// Both meshes in one.
inline SurfaceMesh joined(const SurfaceMesh& a, const SurfaceMesh& b) {
  Points positions(a.positions.rows() + b.positions.rows(), 3);
  positions << a.positions, b.positions;
  Triangles triangles(a.triangles.rows() + b.triangles.rows(), 3);
  triangles << a.triangles, (b.triangles.array() + int(a.positions.rows())).matrix();
  return mesh_of(std::move(positions), std::move(triangles));
}

/// Without `count` triangles from row `first` on.
inline SurfaceMesh without_triangles(const SurfaceMesh& mesh, int first, int count) {
  Triangles left(mesh.triangles.rows() - count, 3);
  left << mesh.triangles.topRows(first), mesh.triangles.bottomRows(mesh.triangles.rows() - first - count);
  return mesh_of(mesh.positions, left);
}

/// Of a closed surface, positive if it is outward.
inline double signed_volume(const Points& positions, const Triangles& triangles) {
  double sum = 0;
  for (const auto& corners : triangles.rowwise()) {
    const Vec3 a = positions.row(corners[0]);
    const Vec3 b = positions.row(corners[1]);
    const Vec3 c = positions.row(corners[2]);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

inline SurfaceMesh inside_out(SurfaceMesh mesh) {
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/// Every triangle with corners of its own, as in an STL file.
inline SurfaceMesh unwelded(const SurfaceMesh& mesh) {
  Points positions(3 * mesh.triangles.rows(), 3);
  Triangles triangles(mesh.triangles.rows(), 3);
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      positions.row(3 * t + k) = mesh.positions.row(mesh.triangles(t, k));
      triangles(t, k) = 3 * t + k;
    }
  }
  return mesh_of(std::move(positions), std::move(triangles));
}

}  // namespace sprung::test
