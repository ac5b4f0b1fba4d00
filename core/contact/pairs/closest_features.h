#pragma once
#include <array>

#include "core/types.h"

namespace sprung {

/// The relative position of two convex features of surfaces: a point and a triangle, or two edges.
struct FeatureDistance {
  Vec3 apart;               // m, from the nearest point of the second to that of the first
  Eigen::Vector4d weights;  // of the four corners, those of the second negative: they add up to `apart`
};

/// After C. Ericson, Real-Time Collision Detection (2005), 5.1.5.
[[nodiscard]] FeatureDistance point_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// Between the edges from `a` to `b` and from `c` to `d`; for parallel ones, some pair of nearest points. Ericson,
/// 5.1.9.
[[nodiscard]] FeatureDistance edge_to_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Either of them, by the first feature's number of corners: 1, a point; 2, an edge.
[[nodiscard]] inline FeatureDistance feature_distance(int count, const std::array<Vec3, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  return count == 1 ? point_to_triangle(a, b, c, d) : edge_to_edge(a, b, c, d);
}

}  // namespace sprung
