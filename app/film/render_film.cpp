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
#include "app/film/film_report.h"
#include "app/film/film_task.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

void draw_here(const FilmTask& task, FilmPipeline& pipeline, const Console& console, Progress& progress) {
  console.detail(fmt::format("drawn by {}", pipeline.driver()));
  PictureWriter writer(task.outputs(), task.format());
  // The skins of the next frame are deformed while this one is drawn and earlier ones are encoded.
  const auto deform_ahead = [&](std::size_t i) {
    return std::async(std::launch::async, [&, frame = task.frames()[i]] { return pipeline.moments(frame - 1); });
  };
  auto next = deform_ahead(0);
  std::vector<Image> sheet;
  for (std::size_t i = 0; i < task.frames().size(); ++i) {
    stop_if_interrupted();
    const FilmPipeline::Moments moments = next.get();
    if (i + 1 < task.frames().size()) next = deform_ahead(i + 1);
    Drawing drawing = task.draw(pipeline, task.frames()[i], moments);
    if (task.is_sheet()) {
      sheet.push_back(std::move(drawing.image));
    } else {
      writer.write(std::move(drawing));
    }
    progress.update(double(i + 1));
  }
  if (task.is_sheet()) writer.write({.number = task.number(task.frames().front()), .image = pipeline.sheet(sheet)});
  writer.close();
}

void draw_by_processes(const FilmTask& task, FilmPipeline& pipeline, std::size_t count, const Console& console,
                       Progress& progress) {
  console.detail(fmt::format("drawn by {} processes", count));
  share_cores(count);
  DrawingProcesses processes(count, [&](std::size_t process, const DrawingProcesses::Send& send) {
    task.draw_share(pipeline, process, count, send, [](std::size_t) { return true; });
  });
  PictureWriter writer(task.sequences(true), task.format());
  for (std::size_t i = 0; i < task.frames().size(); ++i) {
    stop_if_interrupted();
    Image image = processes.receive(i % count).value();
    if (task.has_sequence()) writer.write({.image = std::move(image)});
    progress.update(double(i + 1));
  }
  processes.finish();
  writer.close();
}

void draw_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
               const FrameChoice& choice, const std::vector<Output>& outputs, const Console& console, int jobs) {
  const Film& film = runs.front().film;
  const FilmTask task(film, choice, outputs);
  if (task.frames().empty()) return console.note("--skip-existing: all pictures exist already");
  Progress progress(console, film.render.sheet ? "sheet" : "render", double(task.frames().size()), 1, "frames/s");
  FilmPipeline pipeline(runs, surroundings);
  const std::size_t processes = task.processes(jobs);
  if (processes > 1 && end_worker_threads()) {
    draw_by_processes(task, pipeline, processes, console, progress);
  } else {
    draw_here(task, pipeline, console, progress);
  }
  finish_drawing(progress, task, runs.front().simulation, pipeline.lowest(), console);
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
