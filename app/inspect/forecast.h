#pragma once
#include <optional>

#include "app/console/console.h"
#include "app/scene/film.h"
#include "core/simulation/simulation.h"
#include "core/simulation/time_steps.h"

namespace sprung {

/// The cost of a film of the scene on this machine.
struct Forecast {
  double memory = 0;                         // peak of the whole program, bytes
  std::optional<double> seconds_simulating;  // per frame; for motions only
  double seconds_drawing = 0;                // per frame
  int frames = 0;
  std::optional<StepPlan> plan;  // for motions
};

/// Measures it: runs a copy of the simulation for up to 3 s, then, if it is not at its end, the scene with bricks twice
/// as large for up to 4 s to see how contact goes on, and draws one picture. Throws Error if that fails.
[[nodiscard]] Forecast make_forecast(const Simulation& simulation, const Film& film);

/// Bytes, estimated from the numbers of bricks, vertices and pixels.
[[nodiscard]] double memory_forecast(const Simulation& simulation, const Film& film);

/// A warning if this machine has less memory than that, else empty.
[[nodiscard]] std::string warning_of_memory(double bytes);

/// Prints that warning before a film is made.
void warn_of_memory(const Simulation& simulation, const Film& film, const Console& console);

}  // namespace sprung
