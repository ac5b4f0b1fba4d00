#pragma once
#include "core/contact/watch/crossing_pairs.h"

namespace sprung {

/// How deep surfaces are in each other, and where the deepest point is.
struct CrossingDepth {
  double depth = 0;  // m
  Vec3 position = Vec3::Zero();
};

/// Of two surfaces whose triangles cross in these pairs (one or more; see crossing_pairs()); both may be the same one,
/// which is in itself. The largest distance from the other surface (of itself: from those triangles that face the
/// place) of the vertices of either that are inside the other, in one piece with an edge that crosses it, and of the
/// middles of edges between where they pass through it. What is inside follows from winding numbers, so that surfaces
/// may be open or folded. `tangles`: see tangles_of(); vertices of a surface in itself that belong to any are neither
/// measured nor followed. In double precision. Both have to be complete.
[[nodiscard]] CrossingDepth crossing_depth(const DrawnSurface& a, const DrawnSurface& b, const RowPairs& pairs,
                                           const std::vector<int>& tangles = {});

/// By vertex of a surface that crosses itself in these pairs: the number of the tangle that it belongs to, 0 where it
/// belongs to none. In a tangle are vertices of the pairs, those inside the surface and those where it touches itself,
/// as far as triangles or pairs join them. The surface has to be complete.
[[nodiscard]] std::vector<int> tangles_of(const DrawnSurface& surface, const RowPairs& pairs);

}  // namespace sprung
