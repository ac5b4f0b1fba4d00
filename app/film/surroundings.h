#pragma once
#include <optional>

#include "app/scene/scene_render.h"
#include "render/environment.h"

namespace sprung {

/// What lights the bodies from all around, if the scene names a panorama. Throws Error(kBadInput) naming the file where
/// it cannot be read or gives no light.
[[nodiscard]] std::optional<Environment> read_surroundings(const SceneRender& render);

}  // namespace sprung
