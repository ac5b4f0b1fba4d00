#pragma once
#include <vector>

#include "app/console/console.h"
#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"
#include "app/film/frame_choice.h"

namespace sprung {

/// Throws Error(kUsage) if an output cannot hold what the scene asks for.
void check_outputs(const Film& film, std::size_t runs, const FrameChoice& choice, const std::vector<Output>& outputs);

/// Draws these frames of a run, or of several side by side, and writes them to the outputs. A picture depends on its
/// frame and on the whole recording, which the camera frames, but not on which others are drawn. A single picture of
/// several frames is a sheet of moments. `jobs`: number of processes; 1: this one alone; 0: one per core if there are
/// enough frames. Throws what check_outputs() throws, Error(kFailed), Interrupted.
void render_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
                 const FrameChoice& choice, const std::vector<Output>& outputs, const Console& console, int jobs = 1);

}  // namespace sprung
