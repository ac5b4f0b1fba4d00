#pragma once
#include "core/contact/watch/crossing_pairs.h"

namespace sprung {

/// The depth to which surfaces penetrate each other, and the deepest point.
struct CrossingDepth {
  double depth = 0;  // m
  Vec3 position = Vec3::Zero();
};

/// The penetration depth of two surfaces whose triangles cross in these pairs (one or more; see crossing_pairs()); both
/// may be the same one, in itself. The largest distance from the other surface (of itself: from those triangles that
/// face the point) of the vertices of either that are inside the other and connected to an edge that crosses it, and of
/// the midpoints of edges between their crossings. Inside is decided by winding numbers, so that surfaces may be open
/// or folded; inside itself is a surface where it covers a point twice, or where it is inside out. `tangles`: see
/// tangles_of(); vertices of a surface in itself that belong to any are neither measured nor followed. In double
/// precision. Both must be complete.
[[nodiscard]] CrossingDepth crossing_depth(const DrawnSurface& a, const DrawnSurface& b, const RowPairs& pairs,
                                           const std::vector<int>& tangles = {});

/// By vertex of a surface that crosses itself in these pairs: the number of the tangle that it belongs to, 0: none. A
/// tangle consists of the vertices of the pairs, those inside the surface and those where it touches itself, as far as
/// triangles or pairs connect them. The surface must be complete.
[[nodiscard]] std::vector<int> tangles_of(const DrawnSurface& surface, const RowPairs& pairs);

}  // namespace sprung
