#pragma once
#include "app/build_world.h"

namespace sprung {

/// Glues two bodies of the scene, or the copies of one, together where their skins are near each other, as
/// Scene::glue[row] says. Throws Error(kBadInput) where they are near nowhere.
void glue_bodies(const Scene& scene, std::size_t row, Production& production);

}  // namespace sprung
