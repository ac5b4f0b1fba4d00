#pragma once
#include "core/skin/skin.h"

namespace sprung {

/// A skin with fewer triangles over the same vertices, for what is drawn blurred: of the vertices in one cell of side
/// `cell` (m) whose normals point into the same octant, one stands for all. The octants keep thin parts from
/// collapsing. first[i] is the first coarse triangle of those that the skin's triangles from i on gave; one more row
/// than the skin has triangles. Deterministic.
struct CoarseTriangles {
  Triangles triangles;
  std::vector<int> first;
};
[[nodiscard]] CoarseTriangles coarse_triangles(const Skin& skin, double cell);

/// Which side of a skin's triangles can be seen from outside.
enum class Sides { kBoth, kFront, kBack };

/// One side where the triangles enclose a solid, whatever their creases: every edge has as many triangles on its left
/// as on its right (vertices apart by no more than rounding are one).
[[nodiscard]] Sides visible_sides(const Skin& skin);

}  // namespace sprung
