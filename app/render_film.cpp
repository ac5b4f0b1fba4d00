#include "app/render_film.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/interrupt.h"
#include "app/picture_writer.h"
#include "app/progress.h"
#include "app/units.h"
#include "render/renderer.h"

namespace sprung {
namespace {

Bounds bounds_of(const Production& production, const Recording& recording) {
  Bounds bounds;
  for (const std::vector<Floats3>& frame : recording.frames) {
    for (std::size_t actor = 0; actor < frame.size(); ++actor) {
      bounds.include(skin_positions(production, actor, frame[actor].cast<double>()));
    }
  }
  return bounds;
}

Stage stage_of(const Production& production, const Bounds& bounds) {
  Stage stage;
  for (const DrawnSkin& drawn : production.skins) {
    stage.skins.push_back(&drawn.skin);
    stage.default_colors.emplace_back(Eigen::Vector3f(drawn.color.red, drawn.color.green, drawn.color.blue) / 255.0F);
  }
  stage.has_ground = production.world.ground.has_value();
  if (stage.has_ground) stage.ground.height = production.world.ground->height;
  stage.bounds = bounds;
  return stage;
}

std::vector<SkinShape> shapes_of(const Production& production, const std::vector<Floats3>& nodes) {
  std::vector<SkinShape> shapes;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    const Points positions = nodes[actor].cast<double>();
    const DrawnSkin& drawn = production.skins[actor];
    const BrickGrid& grid = production.world.actors[actor].body.grid;
    shapes.push_back({.positions = skin_positions(production, actor, positions).cast<float>(),
                      .normals = deform_normals(grid, drawn.embedding, drawn.skin.normals, positions).cast<float>()});
  }
  return shapes;
}

/// What the ground could not hold: how deep any vertex was below it, in any frame.
std::string ground_report(const Production& production, const Bounds& bounds) {
  if (!production.world.ground) return "";
  const double depth = std::max(0.0, production.world.ground->height - bounds.low.y());
  return fmt::format(", deepest below the ground {} ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / production.size);
}

Camera camera_of(const Scene& scene, const Bounds& bounds, std::size_t frame, std::size_t frames) {
  const double way = frames > 1 ? static_cast<double>(frame) / static_cast<double>(frames - 1) : 0;
  const double aspect = static_cast<double>(scene.render.resolution[0]) / scene.render.resolution[1];
  return frame_bounds(bounds, aspect, scene.camera.azimuth + way * scene.camera.orbit, scene.camera.elevation);
}

}  // namespace

void render_film(const Production& production, const Recording& recording, const Scene& scene,
                 const std::vector<Output>& outputs, const Console& console) {
  const std::size_t frames = recording.frames.size();
  const auto [width, height] = scene.render.resolution;
  Progress progress(console, "render", static_cast<double>(frames), 1, "frames/s");
  const Bounds bounds = bounds_of(production, recording);
  Renderer renderer(stage_of(production, bounds), {.width = width, .height = height, .samples = scene.render.samples});
  console.detail(fmt::format("drawn by {}", renderer.driver()));
  PictureWriter writer(outputs, width, height, scene.fps);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    stop_if_interrupted();
    const std::vector<SkinShape> shapes = shapes_of(production, recording.frames[frame]);
    writer.write(renderer.draw(shapes, camera_of(scene, bounds, frame, frames)));
    progress.update(static_cast<double>(frame + 1));
  }
  writer.close();
  progress.finish(fmt::format("{} pictures of {} x {}{}", frames, width, height, ground_report(production, bounds)));
}

}  // namespace sprung
