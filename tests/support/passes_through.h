#pragma once
#include "core/types.h"

namespace sprung::test {

/// Whether the segment from `p` to `q` passes through a triangle.
inline bool passes_through(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto volume = [](const Vec3& w, const Vec3& x, const Vec3& y, const Vec3& z) {
    return (x - w).cross(y - w).dot(z - w);
  };
  if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0)) return false;
  const bool side = volume(p, q, a, b) > 0;
  return (volume(p, q, b, c) > 0) == side && (volume(p, q, c, a) > 0) == side;
}

}  // namespace sprung::test
