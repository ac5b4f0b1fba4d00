#include "app/film/film_pipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "app/film/labels.h"
#include "app/film/matte_names.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/decode_image.h"
#include "core/types.h"

namespace sprung {
namespace {

constexpr int kExposures = 8;  // of a picture with motion blur

constexpr std::uint8_t kGutter = 255;  // sRGB, between pictures in one

/// Pixels per metre in the closest view of the film: one smoothness for all frames, so that nothing pops.
double finest_scale(const std::vector<Camera>& cameras, int height) {
  double finest = 0;
  for (const Camera& camera : cameras) finest = std::max(finest, pixels_per_metre(camera, height));
  return finest;
}

Reach common_reach(const std::vector<FilmRun>& runs) {
  std::vector<Reach> all;
  all.reserve(runs.size());
  for (const FilmRun& run : runs) all.push_back(reach_of(run.simulation, run.recording));
  Reach reach = joined(all);
  if (runs.size() > 1) return reach;
  const FilmRun& run = runs.front();
  std::optional<Reach> foreseen = foreseen_reach(run.film, run.simulation, run.recording);
  if (!foreseen || !is_foreseen(*foreseen, reach.bounds)) return reach;
  foreseen->lowest = reach.lowest;
  return *foreseen;
}

std::size_t longest_of(const std::vector<FilmRun>& runs) {
  const auto shorter = [](const FilmRun& a, const FilmRun& b) {
    return a.recording.frames.size() < b.recording.frames.size();
  };
  return std::max_element(runs.begin(), runs.end(), shorter) - runs.begin();
}

/// Pixels between pictures in one, of that height.
int gutter_in(int height) { return std::max(1, int(std::lround(height / 240.0))); }

/// Divides the resolution among runs side by side, or among the pictures of a sheet.
Film with_panel_size(Film scene, std::size_t runs, const Labels& labels) {
  if (!scene.render.sheet && runs == 1) return scene;
  auto [columns, rows] = scene.render.sheet.value_or(std::array{1, 1});
  columns *= int(runs);
  auto& [width, height] = scene.render.resolution;
  const int gutter = gutter_in(height);
  width = std::max(1, (width - labels.reserved(width, height) - (columns - 1) * gutter) / columns);
  height = std::max(1, (height - (rows - 1) * gutter) / rows);
  return scene;
}

RenderOptions options_of(const Film& film) {
  const SceneRender& render = film.render;
  return {.width = render.resolution[0],
          .height = render.resolution[1],
          .samples = render.samples.value_or(samples_of(render.quality)),
          .quality = render.quality,
          .transparent = render.transparent,
          .exposes = render.motion_blur > 0 || film.camera.aperture > 0};
}

std::optional<Legend> first_legend(const FilmRun& run, const ColorRanges& ranges) {
  if (ranges.empty()) return std::nullopt;
  constexpr double kNeverSmooth = std::numeric_limits<double>::infinity();
  return FilmStage(run.film, run.simulation, run.recording, kNeverSmooth, ranges).legend(0);
}

}  // namespace

/// Ranges over all runs; empty if colours show no field.
ColorRanges FilmPipeline::common_ranges(const std::vector<FilmRun>& runs) {
  ColorRanges ranges;
  const SceneRender& render = runs.front().film.render;
  if (render.color_by == Field::kSkin && !render.springs) return ranges;
  for (const FilmRun& run : runs) {
    Film its = run.film;
    its.render = render;
    ranges = merged(ranges, FilmStage(its, run.simulation, run.recording).color_ranges());
  }
  return ranges;
}

std::size_t FilmPipeline::Panel::frame(std::size_t of_film) const {
  return std::min(of_film, run.recording.frames.size() - 1);
}

FilmPipeline::FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings)
    : FilmPipeline(runs, surroundings, common_ranges(runs)) {}

FilmPipeline::FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
                           const ColorRanges& ranges)
    : surroundings_(surroundings),
      film_(runs.front().film),
      reach_(common_reach(runs)),
      labels_(film_.render, first_legend(runs.front(), ranges), runs.size() > 1),
      scene_of_panel_(with_panel_size(film_, runs.size(), labels_)),
      longest_(longest_of(runs)) {
  const auto [width, height] = film_.render.resolution;
  const bool is_whole = runs.size() == 1 && !film_.render.sheet;
  cameras_ = cameras_of(scene_of_panel_, reach_, is_whole ? 1.0 * labels_.reserved(width, height) / width : 0);
  const double pixel = 1 / finest_scale(cameras_, scene_of_panel_.render.resolution[1]);
  for (const FilmRun& run : runs) {
    Film its = run.film;
    its.render = film_.render;
    panels_.emplace_back(std::move(its), run, pixel, ranges);
  }
}

Renderer& FilmPipeline::renderer(Panel& panel) {
  if (!panel.renderer) {
    panel.renderer =
        std::make_unique<Renderer>(panel.stage.stage(reach_.bounds, surroundings_), options_of(scene_of_panel_));
  }
  return *panel.renderer;
}

FilmPipeline::Moments FilmPipeline::moments(std::size_t frame) const {
  const double open = film_.render.motion_blur / 360;
  const int times = open > 0 ? kExposures + 1 : 1;
  Moments moments;
  for (const Panel& panel : panels_) {
    std::vector<std::vector<SkinShape>>& of_run = moments.emplace_back();
    for (int i = 0; i < times; ++i) of_run.push_back(panel.stage.shapes(panel.frame(frame), open * i / kExposures));
  }
  return moments;
}

Image FilmPipeline::draw(std::size_t frame, const Moments& moments) {
  const Camera& camera = cameras_[frame];
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    pictures.push_back(draw(frame, panels_[i], moments[i]));
    if (panels_.size() > 1) labels_.write_name(pictures.back(), panels_[i].run.name);
    if (film_.render.plots) {
      labels_.write_plot(pictures.back(), plot_of(panels_[i].run.recording, panels_[i].frame(frame)));
    }
  }
  Image image = panels_.size() == 1 ? std::move(pictures.front()) : sheet_of_panels(pictures);
  labels_.write_frame(image, camera, frame, frames(), panels_[longest_].run.recording.progress[frame]);
  if (!film_.render.sheet) labels_.write_legend(image, panels_.front().stage.legend(frame));
  return image;
}

Image FilmPipeline::draw(std::size_t frame, Panel& panel, const std::vector<std::vector<SkinShape>>& shapes) {
  Camera camera = cameras_[frame];
  camera.aperture = film_.camera.aperture;
  if (shapes.size() == 1 && camera.aperture == 0) return renderer(panel).draw(shapes.front(), camera);
  std::vector<Exposure> exposures;
  for (std::size_t i = 0; i + 1 < shapes.size(); ++i) exposures.push_back({shapes[i], shapes[i + 1], camera});
  if (exposures.empty()) exposures.push_back({shapes.front(), shapes.front(), camera});
  return renderer(panel).draw(exposures);
}

Passes FilmPipeline::passes(std::size_t frame, const Moments& moments) {
  Panel& panel = panels_.front();
  const std::size_t before = frame == 0 ? 0 : frame - 1;
  const std::size_t after = std::min(frame + 1, frames() - 1);
  const std::vector<SkinShape> shapes_before = panel.stage.shapes(panel.frame(before), 0);
  const std::vector<SkinShape> shapes_after = panel.stage.shapes(panel.frame(after), 0);
  Passes passes = renderer(panel).draw_passes({moments.front().front(), cameras_[frame]},
                                              {shapes_before, cameras_[before]}, {shapes_after, cameras_[after]});
  passes.names = matte_names(panel.scene, panel.run.simulation);
  return passes;
}

Image FilmPipeline::sheet(const std::vector<Image>& pictures) const {
  Image image = sheet_of_panels(pictures);
  labels_.write_legend(image, panels_.front().stage.legend(0));
  return image;
}

Image FilmPipeline::sheet_of_panels(const std::vector<Image>& pictures) const {
  const int columns = film_.render.sheet ? (*film_.render.sheet)[0] : isize(panels_);
  const int gutter = gutter_in(film_.render.resolution[1]);
  const int used = columns * scene_of_panel_.render.resolution[0] + (columns - 1) * gutter;
  return sheet_of(pictures, columns, gutter, film_.render.resolution[0] - used);
}

Image sheet_of(const std::vector<Image>& pictures, int columns, int gutter, int margin) {
  const Image& first = pictures.front();
  const int rows = (isize(pictures) + columns - 1) / columns;
  const int used = columns * first.width + (columns - 1) * gutter;
  Image sheet(used + margin, rows * first.height + (rows - 1) * gutter);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), kGutter);
  if (!first.alpha.empty()) sheet.alpha.assign(sheet.pixels.size() / 3, 0);
  for (std::size_t number = 0; number < pictures.size(); ++number) {
    const int left = int(number) % columns * (first.width + gutter);
    const int top = int(number) / columns * (first.height + gutter);
    for (int y = 0; y < first.height; ++y) {
      const std::size_t to = (top + y) * sheet.width + left;
      const std::size_t from = y * first.width;
      const std::size_t width = first.width;
      std::copy_n(pictures[number].pixels.data() + 3 * from, 3 * width, sheet.pixels.data() + 3 * to);
      if (!first.alpha.empty()) {
        std::copy_n(pictures[number].alpha.data() + from, width, sheet.alpha.data() + to);
      }
    }
  }
  for (int y = 0; y < sheet.height; ++y) {  // the margin repeats the first pixel of the row, where no shadow falls
    const auto row = 3 * std::size_t(y * sheet.width);
    const auto end = 3 * std::size_t(sheet.width);
    for (std::size_t i = 3 * std::size_t(used); i < end; ++i) sheet.pixels[row + i] = sheet.pixels[row + i % 3];
  }
  return sheet;
}

std::optional<Environment> read_surroundings(const SceneRender& render) {
  if (render.environment.empty()) return std::nullopt;
  const std::string name = render.environment.string();
  const std::string bytes = read_file(render.environment);
  const Panorama panorama = decode_panorama(std::as_bytes(std::span(bytes)), name);
  try {
    return Environment(panorama, {.turn = render.environment_turn.value_or(0),
                                  .has_sun = render.environment_sun.value_or(true),
                                  .is_seen = render.environment_background.value_or(false) && !render.transparent});
  } catch (const Error& error) {
    throw Error(error.kind(), name + ": " + error.what());
  }
}

}  // namespace sprung
