#pragma once
#include <filesystem>
#include <functional>

#include "core/simulation/recorder.h"
#include "core/world/world.h"

namespace sprung {

/// Runs `work`. If it throws Diverged, draws that body's bricks in their last state, coloured by strain, and throws
/// Error(kDiverged) with the picture's name added, or the same message if no picture can be drawn.
[[nodiscard]] Recording with_picture_of_diverged(const World& world, const std::filesystem::path& picture,
                                                 const std::function<Recording()>& work);

}  // namespace sprung
