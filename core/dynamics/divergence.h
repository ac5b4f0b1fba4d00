#pragma once
#include <string>

#include "core/world/world.h"

namespace sprung {

/// The first brick with a number that is not finite; else the one whose corners move fastest.
[[nodiscard]] std::size_t worst_brick_of(const Body& body);

/// A remedy for a motion that diverges at a brick of a body, as an instruction: "move bodies 1 and 2 apart, ...", from
/// the state of the world just before: skins that penetrate each other, a speed near that of sound in the material,
/// flattened bricks, springs too stiff for the mass that they move, a part of a single layer of bricks; else a general
/// one.
[[nodiscard]] std::string advice_for_divergence(const World& world, std::size_t body, std::size_t brick);

}  // namespace sprung
