#pragma once
#include <limits>
#include <span>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Triangles binned into the cells of a lattice, for casting rays. Points are in units of cells; the lattice of
/// `counts` cells starts at 0. Keeps references to its arguments.
class TriangleGrid {
 public:
  TriangleGrid(const Points& points, const Triangles& triangles, const Eigen::Vector3i& counts);

  /// Returns whether any triangle lies between the two points, which are at most a few cells apart.
  [[nodiscard]] bool is_blocked(const Vec3& from, const Vec3& to) const;

  /// The distance to the first triangle along a ray, in units of |direction|; infinite if there is none.
  [[nodiscard]] double cast_ray(const Vec3& from, const Vec3& direction) const;

 private:
  [[nodiscard]] std::span<const int> triangles_of(const Eigen::Vector3i& cell) const;
  [[nodiscard]] double way_to(int triangle, const Vec3& from, const Vec3& direction) const;
  template <class Visit>
  void for_each_cell(int triangle, const Visit& visit) const;

  const Points& points_;
  const Triangles& triangles_;
  Eigen::Vector3i counts_;
  std::vector<std::size_t> first_;  // by cell
  std::vector<int> sorted_;
};

}  // namespace sprung
