#pragma once
#include <vector>

#include "tests/support/meshes.h"

namespace sprung::test {

/// A closed comb in the x-y plane, `depth` thick along z from 0: a back of `back` in height, and on it teeth from
/// x = teeth[i].first to teeth[i].second, `height` high.
inline SurfaceMesh comb_mesh(const std::vector<std::pair<double, double>>& teeth, double back, double height,
                             double depth) {
  // The outline, and its cells: columns between the x of the teeth's sides, in two rows.
  std::vector<double> xs;
  for (const auto& [from, to] : teeth) {
    xs.push_back(from);
    xs.push_back(to);
  }
  const std::vector<double> ys{0, back, back + height};
  const auto columns = isize(xs) - 1;
  const auto is_solid = [&](int i, int j) { return i >= 0 && i < columns && (j == 0 || (j == 1 && i % 2 == 0)); };
  std::vector<Vec3> corners;
  const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    for (const Vec3& corner : {a, b, c, a, c, d}) corners.push_back(corner);
  };
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (!is_solid(i, j)) continue;
      const double x0 = xs[i], x1 = xs[i + 1];
      const double y0 = ys[j], y1 = ys[j + 1];
      quad({x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, {x0, y1, depth});
      quad({x0, y0, 0}, {x0, y1, 0}, {x1, y1, 0}, {x1, y0, 0});
      if (!is_solid(i - 1, j)) quad({x0, y0, 0}, {x0, y0, depth}, {x0, y1, depth}, {x0, y1, 0});
      if (!is_solid(i + 1, j)) quad({x1, y0, 0}, {x1, y1, 0}, {x1, y1, depth}, {x1, y0, depth});
      if (!is_solid(i, j - 1)) quad({x0, y0, 0}, {x1, y0, 0}, {x1, y0, depth}, {x0, y0, depth});
      if (!is_solid(i, j + 1)) quad({x0, y1, 0}, {x0, y1, depth}, {x1, y1, depth}, {x1, y1, 0});
    }
  }
  Points positions(corners.size(), 3);
  Triangles triangles(positions.rows() / 3, 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    positions.row(i) = corners[i];
    triangles(i / 3, i % 3) = int(i);
  }
  return mesh_of(std::move(positions), std::move(triangles));
}

}  // namespace sprung::test
