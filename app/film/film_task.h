#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "app/film/drawing_processes.h"
#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"
#include "app/film/frame_choice.h"

namespace sprung {

/// The frames of a film to draw, and where their pictures go.
class FilmTask {
 public:
  /// The film must outlive it.
  FilmTask(const Film& film, const FrameChoice& choice, std::vector<Output> outputs);

  /// Numbered from 1, in order: all of the choice, or as many as a sheet holds, evenly spaced.
  [[nodiscard]] const std::vector<int>& frames() const { return frames_; }
  [[nodiscard]] const std::vector<Output>& outputs() const { return outputs_; }
  /// Returns whether its frames become one picture.
  [[nodiscard]] bool is_sheet() const { return render_.sheet.has_value(); }
  [[nodiscard]] int number(int frame) const { return choice_.number(frame); }
  [[nodiscard]] FilmWriter::Format format() const;
  /// Returns whether an output gets all pictures in order.
  [[nodiscard]] bool has_sequence() const;
  /// The outputs that are sequences, or the others.
  [[nodiscard]] std::vector<Output> sequences(bool wanted) const;

  /// As many as `jobs` says; 0: one per core if there are enough frames; 1 for pictures that use all cores.
  [[nodiscard]] std::size_t processes(int jobs) const;

  [[nodiscard]] Drawing draw(FilmPipeline& pipeline, int frame, const FilmPipeline::Moments& moments) const;
  /// Draws every `step`th frame from `first` on, in a process of its own: writes pictures, sends those of films to the
  /// parent. `is_ready(frame)` waits for that frame (from 0) and returns false if it does not come.
  void draw_share(FilmPipeline& pipeline, std::size_t first, std::size_t step, const DrawingProcesses::Send& send,
                  const std::function<bool(std::size_t frame)>& is_ready) const;

 private:
  FrameChoice choice_;
  std::vector<int> frames_;
  std::vector<Output> outputs_;
  const SceneRender& render_;
  double fps_;
};

/// Chooses the format of "-".
[[nodiscard]] std::vector<Output> with_streams_chosen(std::vector<Output> outputs, const SceneRender& render,
                                                      const FrameChoice& choice);

[[nodiscard]] bool has(const std::vector<Output>& outputs, Output::Kind kind);

/// Divides the cores among that many drawing processes, unless the user did.
void share_cores(std::size_t processes);

}  // namespace sprung
