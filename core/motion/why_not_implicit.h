#pragma once
#include <string>

#include "core/world/world.h"

namespace sprung {

/// What a world has that implicit steps cannot do: obstacles with a restitution. Empty: nothing.
[[nodiscard]] std::string why_not_implicit(const World& world);

}  // namespace sprung
