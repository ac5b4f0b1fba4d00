#pragma once
#include <array>
#include <vector>

#include "core/contact/watch/drawn_surface.h"

namespace sprung {

using RowPairs = std::vector<std::array<int, 2>>;

/// Pairs of cells whose triangles may have a point in common. Both may be the same surface: then each pair once, its
/// lower row first.
[[nodiscard]] RowPairs cells_that_may_cross(const DrawnSurface& a, const DrawnSurface& b);

/// From those pairs of cells, whose vertices are placed: pairs of triangles (rows of either surface's) that have a
/// point in common; touching counts. Of one surface, each pair once, its lower row first, without pairs that share a
/// vertex: those are folded or inverted rather than crossed. In ascending order. Exact: CGAL's predicates, behind a
/// search for a separating axis whose rounding is bounded.
[[nodiscard]] RowPairs crossing_pairs(const DrawnSurface& a, const DrawnSurface& b, const RowPairs& cells);

/// Returns whether two triangles have a point in common. Exact. Triangles without area are treated as segments; those
/// reduced to a point cross nothing.
[[nodiscard]] bool do_intersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace sprung
