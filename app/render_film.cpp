#include "app/render_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <numbers>

#include "app/drawn_stage.h"
#include "app/interrupt.h"
#include "app/picture_writer.h"
#include "app/progress.h"
#include "app/units.h"
#include "core/bricks/corner.h"
#include "core/count_of.h"
#include "render/renderer.h"

namespace sprung {
namespace {

constexpr double kNear = 0.25;  // of the motion's size: what of an obstacle is further off need not be seen

/// What the camera has to see: the bounds of the whole motion, and for each frame and body the points that reach
/// furthest in 26 directions, with the ground below them, where shadows fall.
struct Reach {
  Bounds bounds;
  Points points;
  double lowest = 0;  // m, of the bodies
};

/// Rows: the centre of each face, edge and corner of a cube.
Eigen::Matrix<double, 26, 3> directions() {
  Eigen::Matrix<int, 26, 3> rows;
  int row = 0;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;
    rows.row(row++) << i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1;
  }
  return rows.cast<double>();
}

/// What of the obstacles is near the bodies: of large ones no more than that.
void add_obstacles(const Production& production, const Recording& recording, Reach& reach) {
  const double near = kNear * (reach.bounds.high - reach.bounds.low).maxCoeff();
  const Vec3 low = reach.bounds.low.array() - near;
  const Vec3 high = reach.bounds.high.array() + near;
  Bounds seen = reach.bounds;
  for (const StageObstacle& obstacle : production.obstacles) {
    if (obstacle.skin.positions.rows() == 0) continue;
    for (const double time : recording.progress) {
      const Points skin = skin_positions(obstacle, time);
      const Vec3 from = skin.colwise().minCoeff().transpose().cwiseMax(low);
      const Vec3 to = skin.colwise().maxCoeff().transpose().cwiseMin(high);
      if ((from.array() > to.array()).any()) continue;
      Points corners(2, 3);
      corners << from.transpose(), to.transpose();
      seen.include(corners);
      if (obstacle.movement.is_still()) break;
    }
  }
  Points corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis)
      corners(corner, axis) = on_high_side(corner, axis) ? seen.high[axis] : seen.low[axis];
  }
  if (seen.low == reach.bounds.low && seen.high == reach.bounds.high) return;
  reach.bounds = seen;
  reach.points.conservativeResize(reach.points.rows() + 8, 3);
  reach.points.bottomRows(8) = corners;
}

Reach reach_of(const Production& production, const Recording& recording) {
  const Eigen::Matrix<double, 26, 3> ways = directions();
  Reach reach;
  const auto count = static_cast<Eigen::Index>(26 * recording.frames.size() * production.skins.size());
  reach.points.resize(count, 3);
  Eigen::Index next = 0;
  for (const std::vector<Floats3>& frame : recording.frames) {
    for (std::size_t actor = 0; actor < frame.size(); ++actor) {
      const Points skin = skin_positions(production, actor, frame[actor].cast<double>());
      reach.bounds.include(skin);
      for (int way = 0; way < 26; ++way) {
        Eigen::Index furthest = 0;
        (skin * ways.row(way).transpose()).maxCoeff(&furthest);
        reach.points.row(next++) = skin.row(furthest);
      }
    }
  }
  reach.lowest = reach.bounds.low.y();
  add_obstacles(production, recording, reach);
  const std::optional<double> ground = ground_height(production.world.obstacles);
  if (ground) {
    const Eigen::Index above = reach.points.rows();
    Points below = reach.points;
    below.col(1).setConstant(*ground);
    reach.points.conservativeResize(2 * above, 3);
    reach.points.bottomRows(above) = below;
  }
  return reach;
}

/// What the ground could not hold: how deep any vertex was below it, in any frame.
std::string ground_report(const Production& production, double lowest) {
  const std::optional<double> ground = ground_height(production.world.obstacles);
  if (!ground) return "";
  const double depth = std::max(0.0, *ground - lowest);
  return fmt::format(", deepest below the ground {} ({:.2f} % of the size)", readable(depth, Dimension::kLength),
                     100 * depth / production.size);
}

/// The camera of every frame: one that sees the whole motion from everywhere on its way, carried around it.
std::vector<Camera> cameras_of(const Scene& scene, const Reach& reach, std::size_t frames) {
  constexpr int kStops = 16;
  const Vec3 center = 0.5 * (reach.bounds.low + reach.bounds.high);
  const int stops = scene.camera.orbit == 0 ? 1 : kStops;
  Points seen(reach.points.rows() * stops, 3);
  for (int stop = 0; stop < stops; ++stop) {
    const double way = stops > 1 ? static_cast<double>(stop) / (stops - 1) : 0;
    const double angle = way * scene.camera.orbit * std::numbers::pi / 180;
    const Mat3 back = Eigen::AngleAxisd(-angle, Vec3::UnitY()).toRotationMatrix();
    seen.middleRows(stop * reach.points.rows(), reach.points.rows()) =
        ((reach.points.rowwise() - center.transpose()) * back.transpose()).rowwise() + center.transpose();
  }
  const double aspect = static_cast<double>(scene.render.resolution[0]) / scene.render.resolution[1];
  const Camera first = frame_points(seen, aspect, scene.camera.azimuth, scene.camera.elevation);
  std::vector<Camera> cameras;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double way = frames > 1 ? static_cast<double>(frame) / static_cast<double>(frames - 1) : 0;
    cameras.push_back(carried_around(first, center, way * scene.camera.orbit));
  }
  return cameras;
}

}  // namespace

void render_film(const Production& production, const Recording& recording, const Scene& scene, const FrameRange& range,
                 const std::vector<Output>& outputs, const Console& console) {
  const auto first = static_cast<std::size_t>(range.first - 1);
  const auto end = static_cast<std::size_t>(range.last);
  const auto [width, height] = scene.render.resolution;
  Progress progress(console, "render", range.count(), 1, "frames/s");
  const Reach reach = reach_of(production, recording);
  const std::vector<Camera> cameras = cameras_of(scene, reach, recording.frames.size());
  Renderer renderer(stage_of(production, reach.bounds),
                    {.width = width, .height = height, .samples = scene.render.samples});
  console.detail(fmt::format("drawn by {}", renderer.driver()));
  PictureWriter writer(outputs, width, height, scene.fps, range.first);
  // The skins of the next frame are made ready while this one is drawn and the ones before are encoded.
  const auto make_ready = [&](std::size_t frame) {
    return std::async(std::launch::async,
                      [&, frame] { return shapes_of(production, recording.frames[frame], recording.progress[frame]); });
  };
  std::future<std::vector<SkinShape>> next = make_ready(first);
  for (std::size_t frame = first; frame < end; ++frame) {
    stop_if_interrupted();
    const std::vector<SkinShape> shapes = next.get();
    if (frame + 1 < end) next = make_ready(frame + 1);
    writer.write(renderer.draw(shapes, cameras[frame]));
    progress.update(static_cast<double>(frame + 1 - first));
  }
  writer.close();
  progress.finish(fmt::format("{} of {} x {} pixels{}", count_of(range.count(), "picture"), width, height,
                              ground_report(production, reach.lowest)));
}

}  // namespace sprung
