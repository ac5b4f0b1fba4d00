#pragma once
#include <vector>

#include "core/mesh/query/triangle_grid.h"
#include "core/types.h"

namespace sprung {

/// Finds whether points of surfaces are visible from far away.
class SightLines {
 public:
  /// One or more surfaces (m).
  SightLines(const std::vector<Points>& points, const std::vector<const Triangles*>& triangles);
  SightLines(const SightLines&) = delete;
  SightLines& operator=(const SightLines&) = delete;

  /// Returns whether nothing lies between a point of them and infinity; `outward` and `viewer` (unit): the surface's
  /// normal there and the direction to the viewer.
  [[nodiscard]] bool is_open(const Vec3& position, const Vec3& outward, const Vec3& viewer) const;

 private:
  Vec3 low_ = Vec3::Zero();  // m, where the lattice starts
  double cell_ = 1;          // m, its side
  Points points_;            // in cells
  Triangles triangles_;
  TriangleGrid grid_;

  static constexpr double kCellsAlong = 60;
};

}  // namespace sprung
