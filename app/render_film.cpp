#include "app/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "app/film/exposure.h"
#include "app/film/film_cameras.h"
#include "app/film/film_stage.h"
#include "app/film/labels.h"
#include "app/interrupt.h"
#include "app/picture_writer.h"
#include "app/progress.h"
#include "app/units.h"
#include "core/count_of.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr int kExposures = 8;  // of a picture with motion blur

/// What the ground could not hold: how deep any vertex was below it, in any frame.
std::string ground_report(const Production& production, double lowest) {
  const std::optional<double> ground = ground_height(production.world.obstacles);
  if (!ground) return "";
  const double depth = std::max(0.0, *ground - lowest);
  return fmt::format(", deepest below the ground {} ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / production.size);
}

/// Everything that a picture of a film is made with.
class FilmCrew {
 public:
  FilmCrew(const Production& production, const Recording& recording, const Scene& scene)
      : scene_(scene),
        recording_(recording),
        reach_(reach_of(production, recording)),
        stage_(scene, production, recording),
        labels_(scene.render, stage_.legend()),
        scene_of_picture_(with_picture_size(scene, labels_)),
        cameras_(cameras_of(scene_of_picture_, reach_, scene.render.sheet ? 0 : labels_.reserved())),
        renderer_(stage_.stage(reach_.bounds), options()) {}

  [[nodiscard]] const Reach& reach() const { return reach_; }
  [[nodiscard]] std::string driver() const { return renderer_.driver(); }

  /// The skins at the moments of a picture.
  [[nodiscard]] std::vector<std::vector<SkinShape>> moments(std::size_t frame) const {
    const double open = scene_.render.motion_blur / 360;
    std::vector<std::vector<SkinShape>> moments;
    const int count = open > 0 ? kExposures : 1;
    moments.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) moments.push_back(stage_.shapes(frame, open * i / count));
    return moments;
  }

  [[nodiscard]] Image draw(std::size_t frame, const std::vector<std::vector<SkinShape>>& moments) {
    Exposure exposure;
    for (const std::vector<SkinShape>& shapes : moments) exposure.add(renderer_.draw(shapes, cameras_[frame]));
    Image image = exposure.mean();
    labels_.write_frame(image, cameras_[frame], frame, cameras_.size(), recording_.progress[frame]);
    if (!scene_.render.sheet) labels_.write_legend(image);
    return image;
  }

  [[nodiscard]] Image sheet(const std::vector<Image>& pictures) const {
    const int columns = (*scene_.render.sheet)[0];
    const int used = columns * scene_of_picture_.render.resolution[0];
    Image image = sheet_of(pictures, columns, scene_.render.resolution[0] - used);
    labels_.write_legend(image);
    return image;
  }

 private:
  /// On a sheet each picture has its part of the resolution.
  static Scene with_picture_size(Scene scene, const Labels& labels) {
    if (!scene.render.sheet) return scene;
    const auto [columns, rows] = *scene.render.sheet;
    auto& [width, height] = scene.render.resolution;
    width = std::max(1, static_cast<int>((1 - labels.reserved()) * width) / columns);
    height = std::max(1, height / rows);
    return scene;
  }

  [[nodiscard]] RenderOptions options() const {
    const SceneRender& render = scene_of_picture_.render;
    return {.width = render.resolution[0],
            .height = render.resolution[1],
            .samples = render.samples.value_or(samples_of(render.quality)),
            .quality = render.quality,
            .transparent = render.transparent};
  }

  const Scene& scene_;
  const Recording& recording_;
  Reach reach_;
  FilmStage stage_;
  Labels labels_;
  Scene scene_of_picture_;
  std::vector<Camera> cameras_;
  Renderer renderer_;
};

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

void check_outputs(const SceneRender& render, const std::vector<Output>& outputs) {
  for (const Output& output : outputs) {
    if (output.kind != Output::Kind::kFilm) continue;
    if (render.sheet) throw Error(ErrorKind::kUsage, "render.sheet: one picture is no film; give a folder");
    if (render.transparent) {
      throw Error(ErrorKind::kUsage, "render.transparent: films have no alpha; give a folder for pictures");
    }
  }
}

}  // namespace

void render_film(const Production& production, const Recording& recording, const Scene& scene, const FrameRange& range,
                 const std::vector<Output>& outputs, const Console& console) {
  check_outputs(scene.render, outputs);
  const std::vector<std::size_t> frames = chosen_frames(range, scene.render);
  const auto [width, height] = scene.render.resolution;
  Progress progress(console, "render", static_cast<double>(frames.size()), 1, "frames/s");
  FilmCrew crew(production, recording, scene);
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
    const std::vector<std::vector<SkinShape>> moments = next.get();
    if (i + 1 < frames.size()) next = make_ready(i + 1);
    Image image = crew.draw(frames[i], moments);
    if (scene.render.sheet) {
      sheet.push_back(std::move(image));
    } else {
      writer.write(std::move(image));
    }
    progress.update(static_cast<double>(i + 1));
  }
  if (scene.render.sheet) writer.write(crew.sheet(sheet));
  writer.close();
  progress.finish(fmt::format("{} of {} x {} pixels{}", count_of(static_cast<long>(frames.size()), "picture"), width,
                              height, ground_report(production, crew.reach().lowest)));
}

}  // namespace sprung
