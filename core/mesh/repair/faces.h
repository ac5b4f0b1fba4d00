#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

/// The face of a surface that a triangle belongs to, as a person would point at it: all triangles connected to it in
/// its own plane (to a degree); if these are only a small share of what is connected without sharp edges (30 degrees),
/// as on a cylinder, all of that. Rows of `triangles`, ascending. Points of equal position count as one.
[[nodiscard]] std::vector<int> find_face(const Points& points, const Triangles& triangles, int triangle);

/// The turn of an edge, in degrees, from which on it is sharp.
inline constexpr double kSharpEdge = 30;

/// The ends of the edges along which an oriented surface is concave and turns by more than `min_turn` (degrees).
[[nodiscard]] std::vector<std::array<int, 2>> sharp_inner_edges(const Points& points, const Triangles& triangles,
                                                                double min_turn = kSharpEdge);

}  // namespace sprung
