#include "app/inspect/crossings_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/film/film_pipeline.h"
#include "app/film/film_stage.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "core/simulation/crossing_watch.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/shapes.h"
#include "core/text.h"
#include "core/units.h"
#include "render/brick_cubes.h"
#include "render/renderer.h"

namespace sprung {
namespace {

constexpr int kHalfWidth = 900;    // pixels
constexpr double kAround = 3;      // depths that are shown around the deepest place ...
constexpr double kAtLeast = 0.04;  // ... or this share of the size
constexpr double kBall = 0.03;     // radius of the mark at the deepest place, over half of what is shown there
constexpr double kLifted = 2e-4;   // of the size: distance at which triangles are drawn in front of their skin

const Eigen::Vector3f kCrossing(0.86F, 0.12F, 0.10F);
const Eigen::Vector3f kDeepest(0.05F, 0.05F, 0.06F);
const Eigen::Vector3f kObstacle(0.62F, 0.65F, 0.69F);

/// The skins of a frame as they are drawn.
struct Drawn {
  std::vector<Skin> skins;
  std::vector<Eigen::Vector3f> colors;
  AlignedBox bounds;
};

Drawn skins_of(const Simulation& simulation, const std::vector<Points>& nodes, double time) {
  Drawn drawn;
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const SoftBody& body = simulation.world.bodies[row];
    drawn.skins.push_back(
        with_shape(body.drawn.skin, shape_of(body.grid, body.drawn.skin, body.drawn.embedding, nodes[row])));
    drawn.colors.push_back(srgb(body.drawn.color));
    drawn.bounds.extend(bounding_box(drawn.skins.back().positions));
  }
  for (const StageObstacle& obstacle : simulation.obstacles) {
    if (obstacle.skin.triangles.rows() == 0) continue;
    drawn.skins.push_back(with_shape(obstacle.skin, shape_of(obstacle, obstacle.skin, time)));
    drawn.colors.push_back(kObstacle);
  }
  return drawn;
}

/// Triangles, three rows of points each.
Skin skin_of(const Points& corners, double lifted) {
  Skin skin;
  skin.positions = corners;
  skin.normals.resize(corners.rows(), 3);
  skin.triangles.resize(corners.rows() / 3, 3);
  for (int row = 0; row < skin.triangles.rows(); ++row) {
    skin.triangles.row(row) << 3 * row, 3 * row + 1, 3 * row + 2;
    const Vec3 a = corners.row(3 * row);
    const Vec3 b = corners.row(3 * row + 1);
    const Vec3 c = corners.row(3 * row + 2);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int corner = 3 * row; corner < 3 * row + 3; ++corner) {
      skin.normals.row(corner) = normal.transpose();
      skin.positions.row(corner) += lifted * normal.transpose();
    }
  }
  skin.parts = {{.name = {}, .triangle_count = int(skin.triangles.rows())}};
  return skin;
}

/// `marks`: drawn even if the skins are ghosts.
Image draw(const Drawn& drawn, const Drawn& marks, bool ghosts, double ground, const Camera& camera) {
  Stage stage;
  std::vector<SkinShape> shapes;
  const auto add = [&](const Skin& skin, const Eigen::Vector3f& color, bool ghost) {
    stage.skins.push_back(&skin);
    stage.default_colors.push_back(color);
    stage.ghosts.push_back(ghost);
    shapes.push_back({skin.positions.cast<float>(), skin.normals.cast<float>()});
  };
  for (std::size_t i = 0; i < drawn.skins.size(); ++i) add(drawn.skins[i], drawn.colors[i], ghosts);
  for (std::size_t i = 0; i < marks.skins.size(); ++i) add(marks.skins[i], marks.colors[i], false);
  stage.bounds = drawn.bounds;
  stage.has_ground = !ghosts;
  stage.ground.height = ground;
  Renderer renderer(stage, {.width = kHalfWidth, .height = kHalfWidth, .samples = 4});
  return renderer.draw(shapes, camera);
}

Image draw_deepest(const Simulation& simulation, const std::vector<Points>& nodes, const Crossings& deepest,
                   const Points& triangles) {
  const Drawn drawn = skins_of(simulation, nodes, deepest.time);
  const double half = std::max(kAround * deepest.depth, kAtLeast * simulation.size);
  Skin ball = make_skin(mesh_of(SphereShape{kBall * half}), {});
  ball.positions.rowwise() += deepest.position.transpose();
  const Drawn marks{
      .skins = {skin_of(triangles, kLifted * simulation.size), ball}, .colors = {kCrossing, kDeepest}, .bounds = {}};
  const AlignedBox around(deepest.position - Vec3::Constant(half), deepest.position + Vec3::Constant(half));
  Points corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    corners.row(corner) = around.corner(AlignedBox::CornerType(corner)).transpose();
  }
  const double ground = ground_height(simulation.world.obstacles).value_or(drawn.bounds.min().y());
  return sheet_of({draw(drawn, marks, false, ground, frame_bounds(drawn.bounds, 1, 30, 20)),
                   draw(drawn, marks, true, ground, frame_points(corners, 1, 30, 20))},
                  2, 0, 0);
}

}  // namespace

CrossingsReport find_crossings(const CacheReader& cache, bool draws, const Observer& observer) {
  const Film film = cached_film(cache.header());
  if (!is_motion(film)) throw Error(ErrorKind::kBadInput, "--crossings applies to motions; the cache has none");
  Simulation simulation = cached_simulation(cache.header(), film);
  CrossingsReport report;
  if (cache.frame_count() == 0) return report;
  const auto look = [&](std::vector<Points>& nodes, CrossingWatch& watch, int frame) {
    nodes = cache.positions(frame);
    std::vector<const Points*> of_bodies;
    of_bodies.reserve(nodes.size());
    for (const Points& body : nodes) of_bodies.push_back(&body);
    return watch.look(of_bodies, frame, time_of(film, frame));
  };
  std::vector<Points> nodes = cache.positions(0);
  for (std::size_t row = 0; row < nodes.size(); ++row) simulation.world.bodies[row].positions = nodes[row];
  CrossingWatch watch(film, simulation);
  Progress progress(observer, "crossings", double(cache.frame_count()), 1, "frames/s");
  for (int frame = 1; frame < int(cache.frame_count()); ++frame) {
    observer.check_interrupt();
    report.frames.push_back(look(nodes, watch, frame));
    progress.update(frame);
  }
  const Crossings* deepest = deepest_of(report.frames);
  if (!draws || deepest == nullptr) return report;
  static_cast<void>(look(nodes, watch, deepest->frame));
  report.picture = draw_deepest(simulation, nodes, *deepest, watch.crossing_triangles());
  return report;
}

std::string text_of(const std::vector<Crossings>& frames) {
  const auto crossing = std::count_if(frames.begin(), frames.end(), [](const Crossings& at) { return at.pairs > 0; });
  const auto at_start = std::max_element(frames.begin(), frames.end(), [](const Crossings& a, const Crossings& b) {
    return a.pairs_at_start < b.pairs_at_start;
  });
  std::string text;
  if (crossing > 0) {
    text += fmt::format("{:>6}{:>10}{:>8}{:>12}{:>10}  {}\n", "frame", "time", "pairs", "depth", "of size", "between");
  }
  for (const Crossings& at : frames) {
    if (at.pairs == 0) continue;
    text += fmt::format("{:>6}{:>10}{:>8}{:>12}{:>8.2g} %  {}\n", at.frame + 1, readable(at.time, Dimension::kTime),
                        at.pairs, readable(at.depth, Dimension::kLength), 100 * at.share, at.names);
  }
  text += fmt::format("skins cross in {} of {}", crossing, count_of(long(frames.size()), "frame"));
  if (const Crossings* deepest = deepest_of(frames)) {
    text += fmt::format(", deepest in frame {}: {} at [{:.5g}, {:.5g}, {:.5g}] m", deepest->frame + 1,
                        readable(deepest->depth, Dimension::kLength), deepest->position.x(), deepest->position.y(),
                        deepest->position.z());
  }
  text += "\n";
  if (at_start != frames.end() && at_start->pairs_at_start > 0) {
    text += fmt::format("not counted: up to {} of triangles beside such that crossed at the start\n",
                        count_of(at_start->pairs_at_start, "pair"));
  }
  return text;
}

}  // namespace sprung
