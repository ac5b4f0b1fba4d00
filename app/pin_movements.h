#pragma once
#include "app/build_world.h"
#include "core/motion/newton_system.h"

namespace sprung {

/// How far pins have carried each node of an actor (m x 3, m, from its start) at this share (0..1) of their whole
/// movement; zero along free axes. With `small`, as if the movement were infinitely small: turned nodes move along
/// tangents.
[[nodiscard]] Points pin_movements(const Scene& scene, const Production& production, std::size_t actor, double share,
                                   bool small);

/// Whether any pin of the actor moves.
[[nodiscard]] bool has_moving_pins(const Scene& scene, const Production& production, std::size_t actor);

/// What the pins of an actor hold.
[[nodiscard]] Supports supports_of(const Actor& actor);

}  // namespace sprung
