#pragma once
#include "core/types.h"

namespace sprung {

/// Stage space, the renderer's coordinates: the centre of the stage's bounds is the origin, half their diagonal is 1.
/// Every bias and width in the shaders is in these units, so pictures do not depend on the size in metres.
struct StageSpace {
  Vec3 center = Vec3::Zero();  // m
  double scale = 1;            // 1/m

  explicit StageSpace(const AlignedBox& bounds);
  [[nodiscard]] Vec3 from_world(const Vec3& point) const { return (point - center) * scale; }
  [[nodiscard]] Vec3 to_world(const Vec3& point) const { return point / scale + center; }
};

}  // namespace sprung
