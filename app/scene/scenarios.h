#pragma once
#include <span>
#include <string_view>

#include "app/scene/film.h"

namespace sprung {

/// The motions of a mesh without a scene file.
enum class Scenario {
  kDrop,     // falls upright from 0.08 of its size, or less
  kHang,     // held by its top 8 %, released under gravity
  kSquash,   // two plates press it to 0.6 of its height, and let it go
  kStretch,  // its top is pulled up by 0.6 of its height, held, and brought back
  kTwist,    // its top is turned by half a turn, and back
  kWobble,   // its top is bent to the side by 0.3 of its height and let go
  kThrow,    // flies in an arc, tumbling, and lands
  kTumble    // falls, a little tilted, from 0.4 of its size
};

/// The names, in the order above.
[[nodiscard]] std::span<const std::string_view> scenario_names();

/// Throws Error(kUsage) with the nearest name.
[[nodiscard]] Scenario scenario_from_name(std::string_view name);

inline constexpr double kDropHeight = 0.08;  // in sizes above the ground: lands on its feet, if it has any

/// The vertical axis of the file of a bare mesh.
enum class UpAxis { kY, kZ };

/// Sets what the scenario needs for bodies that are `height` (m) high; times do not depend on the film's
/// duration, so that a shorter film is the beginning of a longer one. Precondition: gravity and the size of the bodies
/// are set. `drop`: the height in sizes that kDrop falls from.
void stage_scenario(Film& film, Scenario scenario, double height, UpAxis up = UpAxis::kY, double drop = kDropHeight);

/// The counterpart of a scenario for statics: no ground, and the body is pinned at its lowest part if nothing else pins
/// it.
void stage_at_rest(Film& film, UpAxis up);

}  // namespace sprung
