#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Pairs of triangles that meet outside the corners and edges that they share: rows of each, the lower one first, in
/// ascending order. Exact, and deterministic: the predicates are CGAL's with exact arithmetic where rounding could
/// matter. Triangles without area are left out. Cost: near linear in the triangles of a usual mesh; works in parallel.
/// `points` p x 3, each place once; `triangles` t x 3.
[[nodiscard]] std::vector<std::array<int, 2>> find_self_intersections(const Points& points, const Triangles& triangles);

}  // namespace sprung
