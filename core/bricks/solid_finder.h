#pragma once
#include <cstdint>
#include <unordered_map>

#include "core/bricks/brick_grid.h"
#include "core/bricks/cell_index.h"

namespace sprung {

/// Finds the brick whose solid is under a place of the surface, by the grid's patches.
class SolidFinder {
 public:
  explicit SolidFinder(const BrickGrid& grid);

  /// `place` and `inward` (unit, or zero where unknown) in lattice units. -1: nothing is known near the place.
  [[nodiscard]] int under(const Vec3& place, const Vec3& inward) const;

 private:
  struct Nearest {
    int brick = -1;
    double cost;  // squared bricks
  };
  void consider(const Eigen::Vector3i& cell, const Vec3& place, const Vec3& inward, Nearest& nearest) const;

  const BrickGrid& grid_;
  CellIndex bricks_;
  CellIndex patches_;
};

}  // namespace sprung
