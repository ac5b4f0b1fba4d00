#pragma once
#include <optional>

#include "app/console/console.h"
#include "app/scene/film.h"
#include "core/simulation/simulation.h"
#include "core/simulation/time_steps.h"

namespace sprung {

/// What making a film of a scene will take on this machine.
struct Forecast {
  double memory = 0;                         // bytes at the most, of the whole program
  std::optional<double> seconds_simulating;  // a frame; only a motion is forecast
  double seconds_drawing = 0;                // a frame
  int frames = 0;
  std::optional<StepPlan> plan;  // of a motion
};

/// Moves a copy of the world for a moment and draws one picture to find out. Throws Error where that fails.
[[nodiscard]] Forecast make_forecast(const Simulation& simulation, const Film& scene);

/// Bytes, from the sizes of what is kept: no measurement.
[[nodiscard]] double memory_forecast(const Simulation& simulation, const Film& scene);

/// A sentence where this machine does not have so much memory; else empty.
[[nodiscard]] std::string warning_of_memory(double bytes);

/// Tells that sentence before a film is made.
void warn_of_memory(const Simulation& simulation, const Film& film, const Console& console);

}  // namespace sprung
