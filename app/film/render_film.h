#pragma once
#include <vector>

#include "app/console/console.h"
#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"

namespace sprung {

/// What a film is drawn of.
struct FrameChoice {
  FrameRange range;
  int start_number = 1;         // of the pictures of the film's first frame
  bool skips_existing = false;  // draws only frames of which a picture, or passes, are missing

  [[nodiscard]] int number(int frame) const { return frame + start_number - 1; }
};

/// Draws these frames of a run, or of several side by side, and writes them to the outputs. A picture depends on its
/// frame and on the whole recording, which the camera frames, but not on which others are drawn. `jobs`: number of
/// processes; 1: this one alone; 0: one per core where there are enough frames. Throws Error(kUsage) where an output
/// cannot hold what the scene asks for, Error(kFailed), Interrupted.
void render_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
                 const FrameChoice& choice, const std::vector<Output>& outputs, const Console& console, int jobs = 1);

}  // namespace sprung
