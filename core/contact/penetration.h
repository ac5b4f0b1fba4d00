#pragma once
#include "core/world/world.h"

namespace sprung {

/// Largest depth (m) of a body's contact points in an obstacle; 0 if none is inside. Points that cannot move, since all
/// corners of their brick are pinned, do not count.
[[nodiscard]] double penetration_depth(const Obstacle& obstacle, const SoftBody& body);

/// Depth in another body, whose contact triangles enclose it; 0 if it has none. Middles of bricks count too: the skins
/// of two coincident bodies are not inside each other.
[[nodiscard]] double penetration_depth(const SoftBody& other, const SoftBody& body);

}  // namespace sprung
