#pragma once
#include <string>
#include <vector>

#include "app/scene/film.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Names of what passes tell apart, by Stage::ids: the ground, the bodies, then the obstacles that are drawn. That of
/// a file without its ending, or of a shape; the second of the same name is "octopus.002".
[[nodiscard]] std::vector<std::string> matte_names(const Film& film, const Simulation& simulation);

}  // namespace sprung
