#pragma once
#include <array>

#include "core/types.h"

namespace sprung {

/// Where a surface runs through itself.
struct Crossings {
  int pairs = 0;                   // of triangles that meet outside the corners and edges that they share
  std::array<int, 2> first{0, 0};  // rows of one of the pairs, the one of the lowest rows; of no meaning without pairs
};

/// Exact, and deterministic: the predicates are CGAL's with exact arithmetic where rounding could matter. Triangles
/// without area are left out. Cost: near linear in the triangles of a usual mesh; works in parallel.
/// `points` p x 3, each place once; `triangles` t x 3.
[[nodiscard]] Crossings find_crossings(const Points& points, const Triangles& triangles);

}  // namespace sprung
