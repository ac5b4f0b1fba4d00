#pragma once
#include <string_view>
#include <vector>

#include "app/scene/scene.h"

namespace sprung {

/// A part of a scene that only a motion can have.
struct MotionOnly {
  std::string_view key;   // of the scene, where it stands ...
  std::size_t row = 0;    // ... and in which of its tables
  std::string_view what;  // "a wind"
};

/// What of a scene states of rest cannot have; modes know no forces at all.
[[nodiscard]] std::vector<MotionOnly> motion_only(const Scene& scene);

}  // namespace sprung
