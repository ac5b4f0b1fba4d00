#include "app/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "app/interrupt.h"
#include "app/picture_writer.h"
#include "app/progress.h"
#include "app/units.h"
#include "core/count_of.h"
#include "core/error.h"

namespace sprung {
namespace {

/// What the ground could not hold: how deep any vertex was below it, in any frame.
std::string ground_report(const Production& production, double lowest) {
  const std::optional<double> ground = ground_height(production.world.obstacles);
  if (!ground) return "";
  const double depth = std::max(0.0, *ground - lowest);
  return fmt::format(", deepest below the ground {} ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / production.size);
}

/// Frames to draw, in order: all of the range, or as many as a sheet has places for.
std::vector<std::size_t> chosen_frames(const FrameRange& range, const SceneRender& render) {
  const auto first = static_cast<std::size_t>(range.first - 1);
  const auto count = static_cast<std::size_t>(range.count());
  std::vector<std::size_t> frames;
  const std::size_t wanted =
      render.sheet ? static_cast<std::size_t>((*render.sheet)[0]) * static_cast<std::size_t>((*render.sheet)[1])
                   : count;
  const std::size_t chosen = std::min(wanted, count);
  for (std::size_t i = 0; i < chosen; ++i) {
    frames.push_back(first + (chosen > 1 ? (i * (count - 1) + (chosen - 1) / 2) / (chosen - 1) : 0));
  }
  return frames;
}

bool has(const std::vector<Output>& outputs, Output::Kind kind) {
  return std::any_of(outputs.begin(), outputs.end(), [kind](const Output& output) { return output.kind == kind; });
}

void check_outputs(const SceneRender& render, std::size_t runs, const std::vector<Output>& outputs) {
  const auto refuse = [](const char* reason) { throw Error(ErrorKind::kUsage, reason); };
  if (has(outputs, Output::Kind::kFilm)) {
    if (render.sheet) refuse("render.sheet: one picture is no film; give a folder");
    if (render.transparent) refuse("render.transparent: films have no alpha; give a folder for pictures");
  }
  if (has(outputs, Output::Kind::kPasses)) {
    if (render.sheet) refuse("render.sheet: passes (.exr) are of single pictures");
    if (runs > 1) refuse("--side-by-side: passes (.exr) are of one run");
  }
  if (render.sheet && runs > 1) refuse("--side-by-side: a sheet shows one run");
}

}  // namespace

void render_film(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
                 const FrameRange& range, const std::vector<Output>& outputs, const Console& console) {
  const Scene& scene = runs.front().scene;
  check_outputs(scene.render, runs.size(), outputs);
  const std::vector<std::size_t> frames = chosen_frames(range, scene.render);
  const auto [width, height] = scene.render.resolution;
  const bool has_passes = has(outputs, Output::Kind::kPasses);
  const bool has_pictures = has(outputs, Output::Kind::kPictures) || has(outputs, Output::Kind::kFilm);
  Progress progress(console, "render", static_cast<double>(frames.size()), 1, "frames/s");
  FilmCrew crew(runs, surroundings);
  console.detail(fmt::format("drawn by {}", crew.driver()));
  PictureWriter writer(outputs, width, height, scene.fps, range.first);
  // The skins of the next frame are made ready while this one is drawn and the ones before are encoded.
  const auto make_ready = [&](std::size_t i) {
    return std::async(std::launch::async, [&, frame = frames[i]] { return crew.moments(frame); });
  };
  auto next = make_ready(0);
  std::vector<Image> sheet;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    stop_if_interrupted();
    const FilmCrew::Moments moments = next.get();
    if (i + 1 < frames.size()) next = make_ready(i + 1);
    Drawing drawing;
    if (has_pictures) drawing.image = crew.draw(frames[i], moments);
    if (has_passes) drawing.passes = crew.passes(frames[i], moments);
    if (scene.render.sheet) {
      sheet.push_back(std::move(drawing.image));
    } else {
      writer.write(std::move(drawing));
    }
    progress.update(static_cast<double>(i + 1));
  }
  if (scene.render.sheet) writer.write({.image = crew.sheet(sheet)});
  writer.close();
  progress.finish(fmt::format("{} of {} x {} pixels{}", count_of(static_cast<long>(frames.size()), "picture"), width,
                              height, ground_report(runs.front().production, crew.lowest())));
}

}  // namespace sprung
