#include "core/mesh/repair/faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/mesh/repair/weld.h"

namespace sprung {
namespace {

constexpr double kInPlane = 1;       // degrees
constexpr double kFlatShare = 0.15;  // of a smooth face: more than a facet of a curve has

using Neighbours = std::vector<std::vector<int>>;  // of each triangle, across its edges

/// The triangles at each edge, by its welded ends.
std::map<std::pair<int, int>, std::vector<int>> triangles_by_edge(const Points& points, const Triangles& triangles) {
  const std::vector<int> welded = weld_points(points);
  std::map<std::pair<int, int>, std::vector<int>> by_edge;
  for (int row = 0; row < triangles.rows(); ++row) {
    for (int corner = 0; corner < 3; ++corner) {
      const int a = welded[triangles(row, corner)];
      const int b = welded[triangles(row, (corner + 1) % 3)];
      by_edge[std::minmax(a, b)].push_back(row);
    }
  }
  return by_edge;
}

Neighbours neighbours_of(const Points& points, const Triangles& triangles) {
  Neighbours neighbours(triangles.rows());
  for (const auto& [edge, rows] : triangles_by_edge(points, triangles)) {
    for (const int one : rows) {
      for (const int other : rows) {
        if (one != other) neighbours[one].push_back(other);
      }
    }
  }
  return neighbours;
}

/// Half of the cross product of two sides.
Points area_vectors(const Points& points, const Triangles& triangles) {
  Points areas(triangles.rows(), 3);
  for (int row = 0; row < triangles.rows(); ++row) {
    const Vec3 a = points.row(triangles(row, 0));
    const Vec3 b = points.row(triangles(row, 1));
    const Vec3 c = points.row(triangles(row, 2));
    areas.row(row) = (b - a).cross(c - a).transpose() / 2;
  }
  return areas;
}

/// What is connected to a triangle by steps that `may_step` allows.
template <class MayStep>
std::vector<int> connected(const Neighbours& neighbours, int start, const MayStep& may_step) {
  std::vector<bool> is_found(neighbours.size());
  std::vector<int> found{start};
  is_found[start] = true;
  for (std::size_t next = 0; next < found.size(); ++next) {
    const int from = found[next];
    for (const int to : neighbours[from]) {
      if (is_found[to] || !may_step(from, to)) continue;
      is_found[to] = true;
      found.push_back(to);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double area_of(const std::vector<int>& rows, const Points& areas) {
  double sum = 0;
  for (const int row : rows) sum += areas.row(row).norm();
  return sum;
}

}  // namespace

std::vector<int> find_face(const Points& points, const Triangles& triangles, int triangle) {
  const Neighbours neighbours = neighbours_of(points, triangles);
  const Points areas = area_vectors(points, triangles);
  const auto angle = [&](int a, int b) {  // degrees; triangles without area go with any other
    const Vec3 one = areas.row(a);
    const Vec3 other = areas.row(b);
    return std::atan2(one.cross(other).norm(), one.dot(other)) * 180 / std::numbers::pi;
  };
  const std::vector<int> flat =
      connected(neighbours, triangle, [&](int, int to) { return angle(triangle, to) <= kInPlane; });
  const std::vector<int> smooth =
      connected(neighbours, triangle, [&](int from, int to) { return angle(from, to) <= kSharpEdge; });
  return area_of(flat, areas) >= kFlatShare * area_of(smooth, areas) ? flat : smooth;
}

std::vector<std::array<int, 2>> sharp_inner_edges(const Points& points, const Triangles& triangles, double min_turn) {
  const Points areas = area_vectors(points, triangles);
  std::vector<std::array<int, 2>> edges;
  for (const auto& [edge, rows] : triangles_by_edge(points, triangles)) {
    if (rows.size() != 2) continue;
    const Vec3 one = areas.row(rows[0]).normalized();
    const Vec3 other = areas.row(rows[1]).normalized();
    if (one.dot(other) > std::cos(min_turn * std::numbers::pi / 180)) continue;
    const Vec3 middle =
        points({triangles(rows[1], 0), triangles(rows[1], 1), triangles(rows[1], 2)}, Eigen::all).colwise().mean();
    if (one.dot(middle - Vec3(points.row(edge.first))) > 0) edges.push_back({edge.first, edge.second});
  }
  return edges;
}

}  // namespace sprung
