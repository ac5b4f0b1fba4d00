#pragma once
#include "core/simulation/simulation.h"
#include "render/renderer.h"

namespace sprung {

/// As the renderer takes it.
[[nodiscard]] Eigen::Vector3f srgb(const Color& color);

/// The skin of a body for these positions of its nodes, m.
[[nodiscard]] SkinShape shape_of(const SoftBody& body, const Points& nodes,
                                 SkinInterpolation interpolation = SkinInterpolation::kBricks);

/// An obstacle at that time of the film (s).
[[nodiscard]] SkinShape shape_of(const StageObstacle& obstacle, double time);

/// Vertices of an obstacle's skin at that time (s), m.
[[nodiscard]] Points skin_positions(const StageObstacle& obstacle, double time);

}  // namespace sprung
