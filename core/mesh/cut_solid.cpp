#include "core/mesh/cut_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace sprung {
namespace {

/// A triangle, and whether it is to be turned over.
using Row = std::pair<int, bool>;

double triangle_area(const WeldedMesh& mesh, int t) {
  const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
  const Vec3 b = mesh.points.row(mesh.triangles(t, 1)).transpose() - a;
  const Vec3 c = mesh.points.row(mesh.triangles(t, 2)).transpose() - a;
  return 0.5 * b.cross(c).norm();
}

void take_triangles(const WeldedMesh& mesh, const std::vector<Row>& rows, Solid& solid) {
  solid.triangles.resize(static_cast<int>(rows.size()), 3);
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    const auto [row, turn] = rows[static_cast<std::size_t>(t)];
    solid.triangles.row(t) = mesh.triangles.row(row);
    if (turn) std::swap(solid.triangles(t, 1), solid.triangles(t, 2));
    solid.source.push_back(mesh.source[static_cast<std::size_t>(row)]);
    solid.turned.push_back(mesh.turned[static_cast<std::size_t>(row)] != turn);
  }
}

void take_points(const WeldedMesh& mesh, Solid& solid) {
  std::vector<int> used(solid.triangles.data(), solid.triangles.data() + solid.triangles.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int& corner : solid.triangles.reshaped<Eigen::RowMajor>()) {
    corner = static_cast<int>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  }
  solid.points = mesh.points(used, Eigen::all);
}

}  // namespace

Solid cut_solid(const WeldedMesh& mesh, const NestGroup& group) {
  std::vector<Row> rows;
  Solid solid;
  for (const Nest& nest : group) {
    const bool inverted = nest.outer->volume < 0;
    double volume = std::abs(nest.outer->volume);
    for (const int t : nest.outer->triangles) rows.emplace_back(t, inverted);
    for (const Shell* cavity : nest.cavities) {
      volume -= std::abs(cavity->volume);
      for (const int t : cavity->triangles) rows.emplace_back(t, inverted);
    }
    if (!nest.is_buried) solid.volume += volume;
  }
  std::sort(rows.begin(), rows.end());
  take_triangles(mesh, rows, solid);
  take_points(mesh, solid);
  return solid;
}

double given_area(const WeldedMesh& mesh, const std::vector<int>& rows) {
  double area = 0;
  for (const int t : rows) {
    if (mesh.source[static_cast<std::size_t>(t)] >= 0) area += triangle_area(mesh, t);
  }
  return area;
}

}  // namespace sprung
