#pragma once
#include <span>

#include "core/types.h"

namespace sprung {

/// The velocity field of a rigid body: shift + spin x position.
struct RigidMotion {
  Vec3 shift;  // m/s
  Vec3 spin;   // rad/s
  [[nodiscard]] Vec3 at(const Vec3& position) const { return shift + spin.cross(position); }
};

struct MovingMass {
  double mass;    // kg
  Vec3 position;  // m
  Vec3 velocity;  // m/s
};

/// The rigid motion with the momentum and angular momentum of these masses: that of least kinetic energy. Masses at one
/// point do not turn.
[[nodiscard]] RigidMotion rigid_motion_of(std::span<const MovingMass> masses);

}  // namespace sprung
