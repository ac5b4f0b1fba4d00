#pragma once
#include <filesystem>
#include <functional>

#include "core/simulation/recorder.h"
#include "core/world/world.h"

namespace sprung {

/// Does `work`; where it throws Diverged, draws the bricks of that body as they last stood, coloured by their strain,
/// and throws Error(kDiverged) with the picture's name added. Where no picture can be made the error passes as it is.
[[nodiscard]] Recording with_picture_of_diverged(const World& world, const std::filesystem::path& picture,
                                                 const std::function<Recording()>& work);

}  // namespace sprung
