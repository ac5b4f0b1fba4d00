#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// A closed surface in units of cells: the box of `counts` cells that holds it begins at 0.
struct CellSurface {
  Points points;  // p x 3, in [0, counts]
  const Triangles& triangles;
  Eigen::Vector3i counts;
};

/// The most cells along one axis that the exact arithmetic of the caster can tell apart.
inline constexpr int kMostCellsPerAxis = 1 << 16;

/// What rays along the axes say of each cell of the box; x fastest, then y, then z.
struct CellSums {
  std::vector<float> weighted;  // sum over the axes of weight x share of the cell inside
  std::vector<float> weight;    // sum over the axes: the more a ray direction crosses the surface in a cell, the better
                                // it measures it; directions along a flat wall hardly count
};

/// Adds to `sums` what rays along `axis` say: 16 rays a cell, the length inside exact along each. Inside is where the
/// surface winds around a point at all. Rays and edges are compared in whole numbers, with one rule for ties, so every
/// ray enters as often as it leaves, and a ray along a face or through an edge does no harm.
void cast_columns(const CellSurface& surface, int axis, CellSums& sums);

}  // namespace sprung
