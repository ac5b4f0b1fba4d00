#pragma once
#include <vector>

#include "core/simulation/body_source.h"
#include "core/simulation/scene.h"

namespace sprung {

/// The poses of a body and its copies (from a LoadedBody at rest), x first, then y, then z. Random placements depend on
/// their seed only.
[[nodiscard]] std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded);

}  // namespace sprung
