#include "app/load/sight_lines.h"

#include <cmath>

namespace sprung {
namespace {

constexpr double kGrazing = 0.05;  // cosine, below which nothing can be made out
constexpr double kAbove = 0.01;    // cells, at which a line starts over its surface

AlignedBox bounds_of(const std::vector<Points>& surfaces) {
  AlignedBox box;
  for (const Points& points : surfaces) box.extend(bounding_box(points));
  return box;
}

Points in_cells(const std::vector<Points>& surfaces, const Vec3& low, double cell) {
  Eigen::Index rows = 0;
  for (const Points& points : surfaces) rows += points.rows();
  Points all(rows, 3);
  rows = 0;
  for (const Points& points : surfaces) {
    all.middleRows(rows, points.rows()) = (points.rowwise() - low.transpose()) / cell;
    rows += points.rows();
  }
  return all;
}

Triangles joined(const std::vector<Points>& surfaces, const std::vector<const Triangles*>& triangles) {
  Eigen::Index rows = 0;
  for (const Triangles* some : triangles) rows += some->rows();
  Triangles all(rows, 3);
  rows = 0;
  int first = 0;
  for (std::size_t surface = 0; surface < surfaces.size(); ++surface) {
    all.middleRows(rows, triangles[surface]->rows()) = triangles[surface]->array() + first;
    rows += triangles[surface]->rows();
    first += int(surfaces[surface].rows());
  }
  return all;
}

}  // namespace

SightLines::SightLines(const std::vector<Points>& points, const std::vector<const Triangles*>& triangles)
    : low_(bounds_of(points).min()),
      cell_(bounds_of(points).sizes().maxCoeff() / kCellsAlong),
      points_(in_cells(points, low_, cell_)),
      triangles_(joined(points, triangles)),
      grid_(points_, triangles_, (bounds_of(points).sizes() / cell_).array().ceil().max(1).cast<int>()) {}

bool SightLines::is_open(const Vec3& position, const Vec3& outward, const Vec3& viewer) const {
  if (outward.dot(viewer) < kGrazing) return false;
  return std::isinf(grid_.cast_ray((position - low_) / cell_ + kAbove * outward, viewer));
}

}  // namespace sprung
