#pragma once
#include "core/world/world.h"

namespace sprung {

/// How deep (m) the contact points of a body are in something at most; 0 where none is. Points that are held where they
/// are, since all corners of their brick are, are in nobody's way and do not count.
[[nodiscard]] double penetration_depth(const Obstacle& obstacle, const SoftBody& body);

/// In another body, whose contact triangles enclose it; 0 where it has none. The middles of bricks count too: the skins
/// of two bodies at the same place do not lie in each other, they are the same.
[[nodiscard]] double penetration_depth(const SoftBody& other, const SoftBody& body);

}  // namespace sprung
