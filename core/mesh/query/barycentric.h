#pragma once
#include "core/types.h"

namespace sprung {

/// Barycentric coordinates of a point projected onto the plane of a triangle: `ab` and `ac` are its sides from corner
/// a, `ap` leads from there to the point. Not finite if the triangle has no area.
[[nodiscard]] inline Vec3 barycentric(const Vec3& ab, const Vec3& ac, const Vec3& ap) {
  const Vec3 normal = ab.cross(ac);
  const double size = normal.norm();
  const double b = ap.cross(ac).dot(normal) / (size * size);
  const double c = ab.cross(ap).dot(normal) / (size * size);
  return {1 - b - c, b, c};
}

}  // namespace sprung
