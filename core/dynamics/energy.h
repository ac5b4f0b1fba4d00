#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// Energy of a body without what the ground is the zero of: kinetic + elastic + potential in the world's gravity
/// (about y = 0), J.
struct Energy {
  double kinetic = 0;
  double elastic = 0;
  double potential = 0;
  [[nodiscard]] double sum() const { return kinetic + elastic + potential; }
};
[[nodiscard]] Energy energy_of(const Body& body, const Vec3& gravity);
/// By body of the world, all or some of them.
[[nodiscard]] std::vector<Energy> energies_of(const World& world);
[[nodiscard]] std::vector<Energy> energies_of(const World& world, std::span<const std::size_t> bodies);

/// What is wrong where bodies that move together have more energy after a while than they can have got, in words; else
/// empty, also where a handle, a load, the wind or an obstacle on its way may have given it. Obstacles at rest and what
/// holds a body still take energy and give none, but for lifting what starts a little too deep; bodies hand it on.
[[nodiscard]] std::string energy_gain(const World& world, std::span<const std::size_t> bodies,
                                      const std::vector<Energy>& before, const std::vector<Energy>& after);

}  // namespace sprung
