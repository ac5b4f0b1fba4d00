#include "core/mesh/query/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sprung {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Eigen::Vector3i cell_of(const Vec3& position, const Eigen::Vector3i& counts) {
  return position.array().floor().cast<int>().max(0).min(counts.array() - 1);
}

std::size_t number_of(const Eigen::Vector3i& cell, const Eigen::Vector3i& counts) {
  return (std::int64_t{cell.z()} * counts.y() + cell.y()) * counts.x() + cell.x();
}

}  // namespace

template <class Visit>
void TriangleGrid::for_each_cell(int triangle, const Visit& visit) const {
  Vec3 low = Vec3::Constant(kNever);
  Vec3 high = -low;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3 point = points_.row(triangles_(triangle, corner));
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector3i first = cell_of(low, counts_);
  const Eigen::Vector3i last = cell_of(high, counts_);
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) visit(number_of({x, y, z}, counts_));
    }
  }
}

TriangleGrid::TriangleGrid(const Points& points, const Triangles& triangles, const Eigen::Vector3i& counts)
    : points_(points), triangles_(triangles), counts_(counts) {
  first_.assign(std::size_t(counts.cast<std::int64_t>().prod()) + 1, 0);
  for (int t = 0; t < triangles_.rows(); ++t) for_each_cell(t, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  sorted_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (int t = 0; t < triangles_.rows(); ++t) for_each_cell(t, [&](std::size_t cell) { sorted_[next[cell]++] = t; });
}

std::span<const int> TriangleGrid::triangles_of(const Eigen::Vector3i& cell) const {
  const std::size_t number = number_of(cell, counts_);
  return std::span(sorted_).subspan(first_[number], first_[number + 1] - first_[number]);
}

/// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
double TriangleGrid::way_to(int triangle, const Vec3& from, const Vec3& direction) const {
  const Vec3 a = points_.row(triangles_(triangle, 0));
  const Vec3 ab = points_.row(triangles_(triangle, 1)).transpose() - a;
  const Vec3 ac = points_.row(triangles_(triangle, 2)).transpose() - a;
  const Vec3 across = direction.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant == 0) return kNever;
  const Vec3 offset = from - a;
  const double u = offset.dot(across) / determinant;
  if (!(u >= 0 && u <= 1)) return kNever;
  const Vec3 around = offset.cross(ab);
  const double v = direction.dot(around) / determinant;
  if (!(v >= 0 && u + v <= 1)) return kNever;
  const double way = ac.dot(around) / determinant;
  return way >= 0 ? way : kNever;
}

bool TriangleGrid::is_blocked(const Vec3& from, const Vec3& to) const {
  const Eigen::Vector3i first = cell_of(from.cwiseMin(to), counts_);
  const Eigen::Vector3i last = cell_of(from.cwiseMax(to), counts_);
  const Vec3 direction = to - from;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const std::span<const int> near = triangles_of({x, y, z});
        if (std::any_of(near.begin(), near.end(), [&](int t) { return way_to(t, from, direction) <= 1; })) return true;
      }
    }
  }
  return false;
}

/// Cell by cell along the ray, after Amanatides and Woo, "A fast voxel traversal algorithm" (1987).
double TriangleGrid::cast_ray(const Vec3& from, const Vec3& direction) const {
  Eigen::Vector3i cell = cell_of(from, counts_);
  for (double best = kNever;;) {
    for (const int t : triangles_of(cell)) best = std::min(best, way_to(t, from, direction));
    double leave = kNever;
    int leave_axis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) continue;
      const double border = cell[axis] + (direction[axis] > 0 ? 1 : 0);
      const double way = (border - from[axis]) / direction[axis];
      if (way >= leave) continue;
      leave = way;
      leave_axis = axis;
    }
    if (best <= leave) return best;
    cell[leave_axis] += direction[leave_axis] > 0 ? 1 : -1;
    if (cell[leave_axis] < 0 || cell[leave_axis] >= counts_[leave_axis]) return best;
  }
}

}  // namespace sprung
