#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Pairs of triangles that intersect outside their shared corners and edges: two rows each, the lower one first, in
/// ascending order. Exact and deterministic: CGAL's predicates, with exact arithmetic where rounding could matter.
/// Triangles without area are ignored. Nearly linear in the triangles of a typical mesh; runs in parallel. `points` p x
/// 3, all distinct; `triangles` t x 3.
[[nodiscard]] std::vector<std::array<int, 2>> find_self_intersections(const Points& points, const Triangles& triangles);

}  // namespace sprung
