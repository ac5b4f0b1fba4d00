#pragma once
#include "core/world/world.h"

namespace sprung {

/// Returns whether it has a surface with edges: a box, cylinder (as a prism) or mesh.
[[nodiscard]] bool has_edges(const Shape& shape);

/// That surface as one of a body, whose few bricks move as one: contact search treats it like a body. Triangles are no
/// longer than a few bricks of `brick_size` (m).
[[nodiscard]] SoftBody obstacle_surface(const Obstacle& obstacle, double brick_size);

/// Moves it to the obstacle's pose `elapsed` (s) after the world's, with the velocities that take it to its pose
/// another dt later.
void move_surface(const Obstacle& obstacle, double elapsed, double dt, SoftBody& surface);

}  // namespace sprung
