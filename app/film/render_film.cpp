#include "app/film/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <future>
#include <iterator>
#include <thread>

#include "app/console/console.h"
#include "app/console/interrupt.h"
#include "app/film/drawing_processes.h"
#include "app/film/film_output.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

/// Depth of the lowest vertex in any frame, m; none without a ground.
std::optional<double> depth_below_ground(const Simulation& simulation, double lowest) {
  const std::optional<double> ground = ground_height(simulation.world.obstacles);
  if (!ground) return std::nullopt;
  return std::max(0.0, *ground - lowest);
}

/// Warns if that is visible.
void warn_of_depth(const Simulation& simulation, double lowest, const Console& console) {
  constexpr double kSeen = 0.01;  // of the size
  const double depth = depth_below_ground(simulation, lowest).value_or(0);
  if (!(depth > kSeen * simulation.size)) return;
  console.warn(
      fmt::format("the drawn skin reaches {} below the ground, {:.1f} % of the size: smaller bricks (bricks) or "
                  "slower impacts keep it up",
                  readable(depth, Dimension::kLength), 100 * depth / simulation.size));
}

/// The deepest penetration of the ground by any vertex in any frame.
std::string ground_report(const Simulation& simulation, double lowest) {
  const std::optional<double> depth_below = depth_below_ground(simulation, lowest);
  if (!depth_below) return "";
  const double depth = *depth_below;
  return fmt::format(", lowest vertex {} below the ground ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / simulation.size);
}

/// Whether all its files exist.
bool exists(const std::vector<Output>& outputs, int number) {
  return std::all_of(outputs.begin(), outputs.end(),
                     [number](const Output& output) { return std::filesystem::exists(output.picture(number)); });
}

/// Frames to draw, numbered from 1, in order: all of the choice, or as many as a sheet holds, evenly spaced.
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

bool has(const std::vector<Output>& outputs, Output::Kind kind) {
  return std::any_of(outputs.begin(), outputs.end(), [kind](const Output& output) { return output.kind == kind; });
}

constexpr std::size_t kMinFrames = 24;     // that justify a process
constexpr std::size_t kMaxProcesses = 16;  // by default: each needs memory for its own pictures

/// The frames to draw, and the outputs.
struct Task {
  const FrameChoice& choice;
  const std::vector<int> frames;
  const std::vector<Output>& outputs;
  const SceneRender& render;
  double fps;

  [[nodiscard]] FilmWriter::Format format() const {
    return {.width = render.resolution[0], .height = render.resolution[1], .fps = fps, .has_alpha = render.transparent};
  }
  [[nodiscard]] bool has_sequence() const {
    return std::any_of(outputs.begin(), outputs.end(), std::mem_fn(&Output::is_sequence));
  }
  [[nodiscard]] std::vector<Output> sequences(bool wanted) const {
    std::vector<Output> some;
    std::copy_if(outputs.begin(), outputs.end(), std::back_inserter(some),
                 [wanted](const Output& output) { return output.is_sequence() == wanted; });
    return some;
  }
  [[nodiscard]] Drawing draw(FilmPipeline& pipeline, int frame, const FilmPipeline::Moments& moments) const {
    Drawing drawing{.number = choice.number(frame)};
    if (has(outputs, Output::Kind::kPictures) || has_sequence()) drawing.image = pipeline.draw(frame - 1, moments);
    if (has(outputs, Output::Kind::kPasses)) drawing.passes = pipeline.passes(frame - 1, moments);
    return drawing;
  }
};

void draw_here(const Task& task, FilmPipeline& pipeline, const Console& console, Progress& progress) {
  console.detail(fmt::format("drawn by {}", pipeline.driver()));
  PictureWriter writer(task.outputs, task.format());
  // The skins of the next frame are deformed while this one is drawn and earlier ones are encoded.
  const auto deform_ahead = [&](std::size_t i) {
    return std::async(std::launch::async, [&, frame = task.frames[i]] { return pipeline.moments(frame - 1); });
  };
  auto next = deform_ahead(0);
  std::vector<Image> sheet;
  for (std::size_t i = 0; i < task.frames.size(); ++i) {
    stop_if_interrupted();
    const FilmPipeline::Moments moments = next.get();
    if (i + 1 < task.frames.size()) next = deform_ahead(i + 1);
    Drawing drawing = task.draw(pipeline, task.frames[i], moments);
    if (task.render.sheet) {
      sheet.push_back(std::move(drawing.image));
    } else {
      writer.write(std::move(drawing));
    }
    progress.update(double(i + 1));
  }
  if (task.render.sheet)
    writer.write({.number = task.choice.number(task.frames.front()), .image = pipeline.sheet(sheet)});
  writer.close();
}

/// Every `step`th frame from `first` on: writes pictures here, sends those of films to the parent.
void draw_share(const Task& task, FilmPipeline& pipeline, std::size_t first, std::size_t step,
                const DrawingProcesses::Send& send) {
  PictureWriter writer(task.sequences(false), task.format());
  for (std::size_t i = first; i < task.frames.size(); i += step) {
    stop_if_interrupted();
    Drawing drawing = task.draw(pipeline, task.frames[i], pipeline.moments(task.frames[i] - 1));
    send(task.has_sequence() ? drawing.image : Image());
    writer.write(std::move(drawing));
  }
  writer.close();
}

void draw_by_processes(const Task& task, FilmPipeline& pipeline, std::size_t count, const Console& console,
                       Progress& progress) {
  console.detail(fmt::format("drawn by {} processes", count));
  const std::size_t threads = std::max(1U, std::thread::hardware_concurrency()) / count;
  // Rasteriser threads per process; 0: the drawing thread alone. Does not override the user's setting.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 0);
  DrawingProcesses processes(count, [&](std::size_t process, const DrawingProcesses::Send& send) {
    draw_share(task, pipeline, process, count, send);
  });
  PictureWriter writer(task.sequences(true), task.format());
  for (std::size_t i = 0; i < task.frames.size(); ++i) {
    stop_if_interrupted();
    Image image = processes.receive(i % count);
    if (task.has_sequence()) writer.write({.image = std::move(image)});
    progress.update(double(i + 1));
  }
  processes.finish();
  writer.close();
}

/// Number of drawing processes.
std::size_t processes_for(const Task& task, int jobs) {
  const std::size_t frames = task.frames.size();
  if (task.render.sheet || task.render.quality == Quality::kFinal) return 1;  // which uses all cores for each picture
  if (jobs > 0) return std::min<std::size_t>(frames, jobs);
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return std::clamp(frames / kMinFrames, std::size_t{1}, std::min(cores, kMaxProcesses));
}

void draw_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
               const FrameChoice& choice, const std::vector<Output>& outputs, const Console& console, int jobs) {
  const Film& film = runs.front().film;
  const Task task{choice, chosen_frames(choice, film.render, outputs), outputs, film.render,
                  film.fps / choice.range.step};
  if (task.frames.empty()) return console.note("--skip-existing: all pictures exist already");
  Progress progress(console, film.render.sheet ? "sheet" : "render", double(task.frames.size()), 1, "frames/s");
  FilmPipeline pipeline(runs, surroundings);
  const std::size_t processes = processes_for(task, jobs);
  if (processes > 1 && end_worker_threads()) {
    draw_by_processes(task, pipeline, processes, console, progress);
  } else {
    draw_here(task, pipeline, console, progress);
  }
  const auto [width, height] = film.render.resolution;
  const std::string made =
      count_of(task.frames.size(), film.render.sheet ? "moment" : "picture") + (film.render.sheet ? " in one" : "");
  progress.finish(fmt::format("{} of {} x {} pixels{}", made, width, height,
                              ground_report(runs.front().simulation, pipeline.lowest())));
  warn_of_depth(runs.front().simulation, pipeline.lowest(), console);
}

constexpr int kSheetSide = 3;  // rows and columns of a sheet whose layout is not given

/// The scene with its film in one picture of the film's shape.
Film as_sheet(Film scene, int frames) {
  const int side = std::clamp(int(std::ceil(std::sqrt(frames))), 1, kSheetSide);
  scene.render.sheet = {side, side};
  return scene;
}

/// Outputs that show the film in a single picture although the scene does not say how.
std::vector<Output> sheets_among(const std::vector<Output>& outputs, const SceneRender& render,
                                 const FrameChoice& choice, bool wanted) {
  std::vector<Output> some;
  for (const Output& output : outputs) {
    const bool is_single = !output.is_sequence() && !output.is_numbered();
    if ((is_single && choice.range.count() > 1 && !render.sheet) == wanted) some.push_back(output);
  }
  return some;
}

/// Chooses the format of "-".
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

}  // namespace

void check_outputs(const Film& film, std::size_t runs, const FrameChoice& choice, const std::vector<Output>& given) {
  const auto refuse = [](const std::string& reason) { throw Error(ErrorKind::kUsage, reason); };
  const SceneRender& render = film.render;
  if (render.quality == Quality::kFinal) {
    require_path_tracer();
  } else if (render.samples && !is_raster_samples(*render.samples)) {
    refuse(fmt::format("render.samples = {}: 1, 4 or 16; other numbers are for render.quality = \"final\"",
                       *render.samples));
  }
  const std::vector<Output> outputs = with_streams_chosen(given, render, choice);
  const std::vector<Output> sheets = sheets_among(outputs, render, choice, true);
  const bool has_sheet = render.sheet || !sheets.empty();
  if (choice.skips_existing && has_sheet) refuse("--skip-existing: a sheet is a single picture");
  for (const Output& output : outputs) {
    if (!output.is_sequence()) continue;
    const bool is_encoded = output.kind == Output::Kind::kFilm || output.stream == Output::Stream::kY4m;
    if (choice.skips_existing) refuse("--skip-existing: a film is made of all its pictures; give a folder");
    if (render.sheet && is_encoded) refuse("render.sheet: a sheet is a single picture; give a .png instead of a film");
    if (render.transparent && is_encoded && !holds_alpha(output.file)) {
      refuse("render.transparent: of films only .mov and .webm have alpha; or give a folder for pictures");
    }
  }
  if (has(render.sheet ? outputs : sheets, Output::Kind::kPasses)) {
    refuse("passes (.exr) are of single pictures, not of a sheet; say which one: --frame 12");
  }
  if (has(outputs, Output::Kind::kPasses) && runs > 1) refuse("--side-by-side: passes (.exr) are of one run");
  if (has_sheet && runs > 1) refuse("--side-by-side: a sheet shows one run; say which picture: --frame 12");
}

void render_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
                 const FrameChoice& choice, const std::vector<Output>& given, const Console& console, int jobs) {
  const Film& film = runs.front().film;
  const std::vector<Output> outputs = with_streams_chosen(given, film.render, choice);
  check_outputs(film, runs.size(), choice, outputs);
  const std::vector<Output> others = sheets_among(outputs, film.render, choice, false);
  if (!others.empty()) draw_film(runs, surroundings, choice, others, console, jobs);
  const std::vector<Output> sheets = sheets_among(outputs, film.render, choice, true);
  if (sheets.empty()) return;
  const Film in_sheet = as_sheet(film, choice.range.count());
  const FilmRun& run = runs.front();
  draw_film({{in_sheet, run.simulation, run.recording, run.name}}, surroundings, choice, sheets, console, jobs);
}

}  // namespace sprung
