#pragma once
#include <vector>

#include "app/load_body.h"
#include "core/pose.h"

namespace sprung {

/// Where a body and its copies are (from a body at rest, turned as its bricks are, the middle of its bounding box at
/// the origin), x first, then y, then z. What is random in it depends on its seed only.
[[nodiscard]] std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded);

}  // namespace sprung
