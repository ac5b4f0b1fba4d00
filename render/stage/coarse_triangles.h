#pragma once
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// A coarser skin over the same vertices, for blurred maps, by vertex clustering: one vertex represents all in a cell
/// of side `cell` (m) whose normals point into the same octant. The octants keep thin parts from collapsing. first[i]
/// is the first coarse triangle made from the skin's triangles i and later; one more row than the skin has triangles.
/// Deterministic.
struct CoarseTriangles {
  Triangles triangles;
  std::vector<int> first;
};
[[nodiscard]] CoarseTriangles coarse_triangles(const Skin& skin, double cell);

/// All triangles if fewer than a hundredth would be left: the skin then consists of thin parts.
[[nodiscard]] CoarseTriangles coarse_or_all_triangles(const Skin& skin, double cell);

/// Half the diagonal of the bounding box, m; 0 without vertices.
[[nodiscard]] double skin_radius(const Skin& skin);

}  // namespace sprung
