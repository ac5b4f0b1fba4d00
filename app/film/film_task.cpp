#include "app/film/film_task.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

#include "app/console/interrupt.h"

namespace sprung {
namespace {

constexpr std::size_t kMinFrames = 24;     // that justify a process
constexpr std::size_t kMaxProcesses = 16;  // by default: each needs memory for its own pictures

std::size_t cores() { return std::max(1U, std::thread::hardware_concurrency()); }

/// Whether all its files exist.
bool exists(const std::vector<Output>& outputs, int number) {
  return std::all_of(outputs.begin(), outputs.end(),
                     [number](const Output& output) { return std::filesystem::exists(output.picture(number)); });
}

std::vector<int> chosen_frames(const FrameChoice& choice, const SceneRender& render,
                               const std::vector<Output>& outputs) {
  std::vector<int> all = choice.range.frames();
  if (choice.skips_existing) {
    all.erase(std::remove_if(all.begin(), all.end(), [&](int frame) { return exists(outputs, choice.number(frame)); }),
              all.end());
  }
  if (!render.sheet) return all;
  const std::size_t count = all.size();
  const std::size_t chosen = std::min(std::size_t((*render.sheet)[0]) * std::size_t((*render.sheet)[1]), count);
  std::vector<int> frames;
  for (std::size_t i = 0; i < chosen; ++i) {
    frames.push_back(all[chosen > 1 ? (i * (count - 1) + (chosen - 1) / 2) / (chosen - 1) : 0]);
  }
  return frames;
}

}  // namespace

FilmTask::FilmTask(const Film& film, const FrameChoice& choice, std::vector<Output> outputs)
    : choice_(choice),
      frames_(chosen_frames(choice, film.render, outputs)),
      outputs_(std::move(outputs)),
      render_(film.render),
      fps_(film.fps / choice.range.step) {}

FilmWriter::Format FilmTask::format() const {
  return {
      .width = render_.resolution[0], .height = render_.resolution[1], .fps = fps_, .has_alpha = render_.transparent};
}

bool FilmTask::has_sequence() const {
  return std::any_of(outputs_.begin(), outputs_.end(), std::mem_fn(&Output::is_sequence));
}

std::vector<Output> FilmTask::sequences(bool wanted) const {
  std::vector<Output> some;
  std::copy_if(outputs_.begin(), outputs_.end(), std::back_inserter(some),
               [wanted](const Output& output) { return output.is_sequence() == wanted; });
  return some;
}

std::size_t FilmTask::processes(int jobs) const {
  if (render_.sheet || render_.quality == Quality::kFinal) return 1;
  if (jobs > 0) return std::min<std::size_t>(frames_.size(), jobs);
  return std::clamp(frames_.size() / kMinFrames, std::size_t{1}, std::min(cores(), kMaxProcesses));
}

Drawing FilmTask::draw(FilmPipeline& pipeline, int frame, const FilmPipeline::Moments& moments) const {
  Drawing drawing{.number = choice_.number(frame)};
  if (has(outputs_, Output::Kind::kPictures) || has_sequence()) drawing.image = pipeline.draw(frame - 1, moments);
  if (has(outputs_, Output::Kind::kPasses)) drawing.passes = pipeline.passes(frame - 1, moments);
  return drawing;
}

void FilmTask::draw_share(FilmPipeline& pipeline, std::size_t first, std::size_t step,
                          const DrawingProcesses::Send& send,
                          const std::function<bool(std::size_t frame)>& is_ready) const {
  PictureWriter writer(sequences(false), format());
  for (std::size_t i = first; i < frames_.size() && is_ready(frames_[i] - 1); i += step) {
    stop_if_interrupted();
    Drawing drawing = draw(pipeline, frames_[i], pipeline.moments(frames_[i] - 1));
    send(has_sequence() ? drawing.image : Image());
    writer.write(std::move(drawing));
  }
  writer.close();
}

std::vector<Output> with_streams_chosen(std::vector<Output> outputs, const SceneRender& render,
                                        const FrameChoice& choice) {
  const bool is_picture = render.sheet || choice.range.count() == 1;
  for (Output& output : outputs) {
    if (output.stream == Output::Stream::kAny) {
      output.stream = is_picture ? Output::Stream::kPng : Output::Stream::kY4m;
    }
  }
  return outputs;
}

bool has(const std::vector<Output>& outputs, Output::Kind kind) {
  return std::any_of(outputs.begin(), outputs.end(), [kind](const Output& output) { return output.kind == kind; });
}

void share_cores(std::size_t processes) {
  const std::size_t threads = cores() / processes;
  // Rasteriser threads per process; 0: the drawing thread alone.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 0);
}

}  // namespace sprung
