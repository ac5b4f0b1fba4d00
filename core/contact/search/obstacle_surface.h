#pragma once
#include <optional>

#include "core/world/world.h"

namespace sprung {

/// The surface of a box, cylinder (a prism) or mesh as that of a body, whose few bricks move as one: what is sought
/// among bodies is sought there in the same way. Triangles are no longer than a few bricks of `brick_size` (m). None
/// for other shapes.
[[nodiscard]] std::optional<SoftBody> obstacle_surface(const Obstacle& obstacle, double brick_size);

/// Puts it where the obstacle is, `elapsed` (s) after where the world has it, with the velocities that take it to where
/// that is in another dt.
void move_surface(const Obstacle& obstacle, double elapsed, double dt, SoftBody& surface);

}  // namespace sprung
