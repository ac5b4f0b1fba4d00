#pragma once
#include <vector>

#include "app/build_world.h"
#include "render/renderer.h"

namespace sprung {

/// What a renderer needs of a production; `bounds` of the whole motion, m. The skins stay where they are.
[[nodiscard]] Stage stage_of(const Production& production, const Bounds& bounds);

/// The skins of all actors for these positions of their nodes, m.
[[nodiscard]] std::vector<SkinShape> shapes_of(const Production& production, const std::vector<Floats3>& nodes);

}  // namespace sprung
