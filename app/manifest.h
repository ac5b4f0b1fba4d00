#pragma once
#include <string>

#include "app/recording.h"

namespace sprung {

/// How a run came about, as JSON: version and build of the program, the scene as resolved, a hash of each mesh file it
/// names and of the state in the last frame, and how long each frame took (s, wall clock; those of an earlier run that
/// this one went on from included).
[[nodiscard]] std::string manifest_json(const Scene& scene, const Recording& recording);

}  // namespace sprung
