#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Energy of a body: kinetic + elastic + potential in the world's gravity (relative to y = 0), J.
struct Energy {
  double kinetic = 0;
  double elastic = 0;
  double potential = 0;
  [[nodiscard]] double sum() const { return kinetic + elastic + potential; }
};
[[nodiscard]] Energy energy_of(const Body& body, const Vec3& gravity);
/// The energies of all bodies of the world, or of some of them, by body.
[[nodiscard]] std::vector<Energy> energies_of(const World& world);
[[nodiscard]] std::vector<Energy> energies_of(const World& world, std::span<const std::size_t> bodies);

/// A message if bodies that move together have more energy after a while than they can have received; else empty, also
/// if a handle, a load, the wind or a moving obstacle may have supplied it. Obstacles at rest and supports dissipate
/// energy and add none, except for lifting what starts a little too deep; bodies pass it on.
[[nodiscard]] std::string energy_gain(const World& world, std::span<const std::size_t> bodies,
                                      const std::vector<Energy>& before, const std::vector<Energy>& after);

}  // namespace sprung
