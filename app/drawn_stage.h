#pragma once
#include <vector>

#include "app/build_world.h"
#include "render/renderer.h"

namespace sprung {

/// What a renderer needs of a production; `bounds` of the whole motion, m. The skins stay where they are.
[[nodiscard]] Stage stage_of(const Production& production, const Bounds& bounds);

/// The skins of all actors for these positions of their nodes (m), and of the obstacles at that time of the film (s).
[[nodiscard]] std::vector<SkinShape> shapes_of(const Production& production, const std::vector<Floats3>& nodes,
                                               double time);

/// The skin of one actor for these positions of its nodes, m.
[[nodiscard]] SkinShape shape_of(const Production& production, std::size_t actor, const Points& nodes,
                                 Riding riding = Riding::kBricks);

/// An obstacle at that time of the film (s).
[[nodiscard]] SkinShape shape_of(const StageObstacle& obstacle, double time);

/// Vertices of an obstacle's skin at that time (s), m.
[[nodiscard]] Points skin_positions(const StageObstacle& obstacle, double time);

}  // namespace sprung
