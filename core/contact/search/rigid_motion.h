#pragma once
#include "core/types.h"

namespace sprung {

/// Velocity of a rigid body at a place: shift + spin x place.
struct RigidMotion {
  Vec3 shift;  // m/s
  Vec3 spin;   // rad/s
  [[nodiscard]] Vec3 at(const Vec3& position) const { return shift + spin.cross(position); }
};

}  // namespace sprung
