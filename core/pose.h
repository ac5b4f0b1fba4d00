#pragma once
#include "core/types.h"

namespace sprung {

/// From where a thing is at rest, in a frame of its own, to where it is in the world: rotation first.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  // m; where the origin of its frame goes
};

/// The rotation about x, then y, then z (axes of the world), by degrees.
[[nodiscard]] Mat3 rotation_matrix(const Vec3& degrees);

}  // namespace sprung
