#pragma once
#include "app/build_world.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/world/keyframes.h"

namespace sprung {

/// The way of a pin: its keyframes, or even from the start of the film to its end.
[[nodiscard]] Movement movement_of(const Pin& pin, const Scene& scene);

/// How far pins that hold from the start have carried each node of an actor (m x 3, m) by a time (s) of the film; zero
/// along free axes. With `small`, as if the movement were infinitely small: turned nodes move along tangents.
[[nodiscard]] Points pin_movements(const Scene& scene, const Production& production, std::size_t actor, double time,
                                   bool small);

/// What the pins of an actor hold.
[[nodiscard]] Supports supports_of(const Actor& actor);

}  // namespace sprung
