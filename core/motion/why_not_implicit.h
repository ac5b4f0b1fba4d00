#pragma once
#include <string>

#include "core/world/world.h"

namespace sprung {

/// What a world has that implicit steps cannot do: loads, wind, glue, bodies that touch each other, obstacles other
/// than level ground at rest, restitution. Empty: nothing. That a body touches itself is not seen.
[[nodiscard]] std::string why_not_implicit(const World& world);

}  // namespace sprung
