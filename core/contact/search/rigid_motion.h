#pragma once
#include "core/types.h"

namespace sprung {

/// The velocity field of a rigid body: shift + spin x position.
struct RigidMotion {
  Vec3 shift;  // m/s
  Vec3 spin;   // rad/s
  [[nodiscard]] Vec3 at(const Vec3& position) const { return shift + spin.cross(position); }
};

}  // namespace sprung
