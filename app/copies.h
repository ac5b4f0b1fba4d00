#pragma once
#include <vector>

#include "app/load_body.h"

namespace sprung {

/// From a body at rest, turned as its bricks are, to where it is in the world: rotation first.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  // m; where the middle of the bounding box at rest goes
};

/// Where a body and its copies are, x first, then y, then z. What is random in it depends on its seed only.
[[nodiscard]] std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded);

}  // namespace sprung
