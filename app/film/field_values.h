#pragma once
#include "app/recording.h"
#include "app/scene/scene_render.h"

namespace sprung {

/// A field at the nodes of one actor in one frame, SI: displacement from the start (m), speed by differences between
/// frames (m/s), largest principal stretch, von Mises strain, von Mises stress (Pa), volume over volume at rest, fill,
/// or Young's modulus (Pa) for kRegion. Not for kSkin.
[[nodiscard]] Eigen::VectorXd field_values(Field field, const Production& production, const Recording& recording,
                                           std::size_t frame, std::size_t actor, double fps);

/// Whether it differs from frame to frame.
[[nodiscard]] bool is_moving(Field field);

}  // namespace sprung
