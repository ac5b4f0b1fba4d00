#pragma once
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// A point of a solid's surface and the thickness of the solid there.
struct WallSample {
  Vec3 position = Vec3::Zero();
  Vec3 outward = Vec3::Zero();  // unit normal
  double thickness = 0;         // distance along the inward normal to the opposite wall
};

/// `count` points distributed evenly by area; those without an opposite wall (on self-intersecting surfaces) are left
/// out; a shell has its given thickness. Units of the solid. Deterministic. Cost: one pass over the triangles and a few
/// hundred tests per point.
[[nodiscard]] std::vector<WallSample> sample_thickness(const Solid& solid, int count);

/// The same by solid, each with points in proportion to its area.
[[nodiscard]] std::vector<std::vector<WallSample>> sample_thickness(const std::vector<Solid>& solids, int count);

/// The quantile `share` (0 to 1) of the thickness of all samples; 0 without any.
[[nodiscard]] double thickness_quantile(const std::vector<std::vector<WallSample>>& walls, double share);

[[nodiscard]] double surface_area(const Solid& solid);

}  // namespace sprung
