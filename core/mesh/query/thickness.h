#pragma once
#include <vector>

#include "core/mesh/solid.h"

namespace sprung {

/// A point of a solid's surface, and how thick the solid is there.
struct WallSample {
  Vec3 place = Vec3::Zero();
  Vec3 outward = Vec3::Zero();  // unit normal
  double thickness = 0;         // way along the inward normal to the far wall
};

/// `count` points spread evenly over the surface by area; those without a far wall (a surface that crosses itself) are
/// left out; a shell has the thickness it was given. Units of the solid. Deterministic. Cost: like one pass over the
/// triangles and a few hundred tests a point.
[[nodiscard]] std::vector<WallSample> sample_thickness(const Solid& solid, int count);

/// The same for all solids, each with points by its share of the surface; by solid.
[[nodiscard]] std::vector<std::vector<WallSample>> sample_thickness(const std::vector<Solid>& solids, int count);

/// What `share` (0 to 1) of the samples are at most; 0 where there are none.
[[nodiscard]] double thickness_quantile(const std::vector<WallSample>& samples, double share);

[[nodiscard]] double surface_area(const Solid& solid);

}  // namespace sprung
