#pragma once
#include <string>

#include "core/world/world.h"

namespace sprung {

/// What a world has that implicit steps cannot do: glue, bodies that touch each other, restitution. Empty:
/// nothing. That a body touches itself is not seen.
[[nodiscard]] std::string why_not_implicit(const World& world);

}  // namespace sprung
