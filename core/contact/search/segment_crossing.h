#pragma once
#include "core/types.h"

namespace sprung {

/// Six times the signed volume of a tetrahedron: positive if `d` is in front of the triangle a, b, c.
[[nodiscard]] inline double volume_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// How the segment from `p` to `q` crosses a triangle: 1, from behind it to its front; -1, the other way; 0, not at
/// all. Up to rounding.
[[nodiscard]] inline int segment_crossing(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const bool ends_in_front = volume_of(a, b, c, q) > 0;
  if ((volume_of(a, b, c, p) > 0) == ends_in_front) return 0;
  const bool side = volume_of(p, q, a, b) > 0;
  if ((volume_of(p, q, b, c) > 0) != side || (volume_of(p, q, c, a) > 0) != side) return 0;
  return ends_in_front ? 1 : -1;
}

}  // namespace sprung
