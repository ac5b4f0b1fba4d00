#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Cuts a polygon of n >= 3 corners (rows of `points`) into exactly n - 2 triangles of its corners, same winding,
/// appended to `triangles`. Convex polygons become a fan; others are cut ear by ear in the plane of their area vector.
void cut_polygon(const Points& points, std::span<const int> polygon, std::vector<std::array<int, 3>>& triangles);

}  // namespace sprung
