#pragma once
#include <string>
#include <vector>

#include "app/scene/film.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Names of the objects that passes distinguish, by Stage::ids: the ground, the bodies, then the drawn obstacles. Each
/// is a file's name without its extension, or a shape's; the second of the same name is "octopus.002".
[[nodiscard]] std::vector<std::string> matte_names(const Film& film, const Simulation& simulation);

}  // namespace sprung
