#pragma once
#include <cstdint>
#include <string>

#include "core/world/world.h"

namespace sprung::test {

/// A body of random shape, size, material, damping, position and speed above the ground.
struct Drop {
  World world;          // one body
  double size = 0;      // m, longest side of the body
  double period = 0;    // s, of its slowest vibration, estimated
  double duration = 0;  // s: the fall, and a few periods
  std::string description;
};

/// Drop number `index` of a series; the same for the same numbers. Poisson's ratio is `min_poisson` to 0.49.
[[nodiscard]] Drop random_drop(std::uint32_t seed, std::uint32_t index, Model model, double min_poisson,
                               const StrainEnergyLaw& law = {});

/// The outcome of a drop.
struct DropResult {
  std::string fault;            // empty: none
  double deepest = 0;           // share of the size that a contact point, or with the guard what is drawn, was below
                                // the ground
  double energy_gain = 0;       // highest energy over the first, share of the first
  int inverted_bricks = 0;      // at the end
  int inverted_on_the_way = 0;  // most, at the checks
  double smallest_volume = 0;   // of a brick over that at rest, at the end
  int halvings = 0;             // frames rolled back
  long brick_steps = 0;
};

[[nodiscard]] DropResult run_drop(Drop& drop);

}  // namespace sprung::test
