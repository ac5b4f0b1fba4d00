#pragma once
#include "core/types.h"

namespace sprung {

/// A surface of triangles.
struct CoarseSurface {
  Points points;        // p x 3
  Triangles triangles;  // t x 3
};

/// Collapses edges shorter than `shortest` (in units of the points), shortest first, as long as the surface keeps its
/// topology and no triangle turns over; new points are placed to preserve volume and shape best (P. Lindstrom and G.
/// Turk, "Fast and memory efficient polygonal simplification", IEEE Visualization 1998). A non-manifold surface is
/// returned unchanged. Deterministic.
[[nodiscard]] CoarseSurface coarsen(const Points& points, const Triangles& triangles, double shortest);

}  // namespace sprung
