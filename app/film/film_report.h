#pragma once
#include <string>

#include "app/console/console.h"
#include "app/film/film_task.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Ends the stage in which pictures were drawn, and warns if the skins, down to `lowest` (m), are seen to reach below
/// the ground. `remark`: added to its result.
void finish_drawing(Progress& progress, const FilmTask& task, const Simulation& simulation, double lowest,
                    const Console& console, const std::string& remark = "");

}  // namespace sprung
