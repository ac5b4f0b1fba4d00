#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// How much the triangles whose rows are given enclose: the median, over at most 1000 of them, of the winding number in
/// their middles, without sign. 1/2 for a closed surface, 0.3 for half a sphere, 0 for a sheet, a band, or triangles at
/// random. Changes little where triangles are missing or do not quite meet.
[[nodiscard]] double enclosure(const Points& points, const Triangles& triangles, const std::vector<int>& rows);

/// From this on a surface counts as the boundary of something.
inline constexpr double kEncloses = 0.25;

}  // namespace sprung
