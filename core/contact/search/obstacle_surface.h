#pragma once
#include <optional>

#include "core/world/world.h"

namespace sprung {

/// The surface of a box, cylinder (a prism) or mesh as that of a body, whose few bricks move as one: contact search
/// treats it like a body. Triangles are no longer than a few bricks of `brick_size` (m). None for other shapes.
[[nodiscard]] std::optional<SoftBody> obstacle_surface(const Obstacle& obstacle, double brick_size);

/// Moves it to the obstacle's pose `elapsed` (s) after the world's, with the velocities that take it to its pose
/// another dt later.
void move_surface(const Obstacle& obstacle, double elapsed, double dt, SoftBody& surface);

}  // namespace sprung
