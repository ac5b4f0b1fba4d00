#include "app/export/viewer_take.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <optional>

#include "app/console/interrupt.h"
#include "app/export/posed_meshes.h"
#include "app/film/field_colors.h"
#include "app/film/film_cameras.h"
#include "app/film/film_stage.h"
#include "app/film/overlays.h"
#include "core/io/animation.h"
#include "core/simulation/run_cache.h"

namespace sprung {
namespace {

constexpr std::array kFields{Field::kDisplacement, Field::kSpeed, Field::kStrain, Field::kStress};

/// Collects a take, which holds no references.
class TakeMaker {
 public:
  TakeMaker(const CachedFilmView& view, const FrameRange& range)
      : view_(view), frames_(range.frames()), recording_(cached_recording(view.cache, view.film)) {
    const Reach reach = reach_of(view.simulation, recording_);
    const auto [width, height] = view.film.render.resolution;
    take_.name = view.name;
    take_.fps = view.film.fps / range.step;
    take_.first_frame = range.first;
    take_.frame_step = range.step;
    take_.progress = recording_.progress_name;
    for (const int frame : frames_) take_.at.push_back(recording_.progress[row_of(frame)]);
    take_.camera = cameras_of(view.film, reach, 0).at(row_of(frames_.front()));
    take_.aspect = double(width) / height;
    take_.ground = reach.ground;
  }

  void add_bodies() {
    const std::vector<SoftBody>& bodies = view_.simulation.world.bodies;
    std::vector<PosedMesh> meshes =
        posed_meshes(view_.simulation, view_.film, view_.cache.positions(row_of(frames_.front())));
    for (const PosedMesh& mesh : meshes) {
      const Eigen::Index count = mesh.positions.rows();
      take_.meshes.push_back({.brick = std::vector<int>(count), .local = Floats3::Zero(count, 3), .obstacle = {}});
    }
    const std::vector<std::size_t> mesh_of = meshes_of_bodies(view_.simulation);
    int nodes = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
      const int first_brick = take_.add_bricks(bodies[row].grid, nodes);
      const Origin& origin = view_.simulation.origins[row];
      place_vertices(take_.meshes[mesh_of[row]], origin.file_vertices, origin.file_embedding, first_brick);
      nodes += bodies[row].node_count();
    }
    for (const int frame : frames_) {
      stop_if_interrupted();
      take_.add_frame(recording_.frames[row_of(frame)]);
    }
    for (const StageObstacle& obstacle : view_.simulation.obstacles) {
      if (obstacle.skin.positions.rows() > 0) meshes.push_back(add_obstacle(obstacle, meshes.size()));
    }
    take_.model = static_glb(meshes);
  }

  /// Whether the page of this take has the field.
  [[nodiscard]] bool has(Field field) const {
    if (field == Field::kSpeed) return recording_.progress_name == "time_s";
    return field == wanted() || std::find(kFields.begin(), kFields.end(), field) != kFields.end();
  }
  [[nodiscard]] Field wanted() const { return view_.film.render.color_by; }

  [[nodiscard]] ColorRanges ranges_of(Field field) const {
    return FieldColors(coloured_by(field), view_.simulation, recording_).ranges();
  }

  void add_field(Field field, const ColorRanges& ranges) {
    const FieldColors colors(coloured_by(field), view_.simulation, recording_, ranges);
    if (field == wanted()) take_.shown_field = int(take_.fields.size());
    ViewerField& made = take_.fields.emplace_back();
    made.legend = colors.legend(0);
    for (const int frame : frames_) {
      stop_if_interrupted();
      for (std::size_t body = 0; body < view_.simulation.world.bodies.size(); ++body) {
        made.add(colors.map_coordinates(row_of(frame), body));
      }
      if (!is_moving(field)) break;
    }
  }

  void add_springs() {
    Film film = view_.film;
    film.render.springs = true;
    film.render.color_range = RangeOver::kFilm;
    film.render.color_low.reset();
    film.render.color_high.reset();
    take_.spring_stretch = FilmStage(film, view_.simulation, recording_).legend(0);
    std::vector<float> lengths;
    int first = 0;
    for (const SoftBody& body : view_.simulation.world.bodies) {
      const SpringSet springs = springs_of(body, std::vector<bool>(body.grid.nodes.size(), true));
      for (const auto& [from, to] : springs.nodes) take_.springs.push_back({first + from, first + to});
      for (const double length : springs.rest) lengths.push_back(float(length));
      first += body.node_count();
    }
    take_.rest_lengths = Eigen::Map<const Eigen::VectorXf>(lengths.data(), Eigen::Index(lengths.size()));
  }

  [[nodiscard]] ViewerTake finish() { return std::move(take_); }

 private:
  static std::size_t row_of(int frame) { return std::size_t(frame) - 1; }

  PosedMesh add_obstacle(const StageObstacle& obstacle, std::size_t number) {
    std::vector<Floats3>& positions = take_.meshes.emplace_back().obstacle;
    for (const int frame : frames_) {
      positions.push_back(shape_of(obstacle, obstacle.skin, recording_.progress[row_of(frame)]).positions);
    }
    PosedMesh mesh;
    mesh.name = fmt::format("obstacle_{}", number);
    mesh.rest = &obstacle.skin;
    mesh.color = srgb(obstacle.color);
    mesh.positions = positions.front().cast<double>();
    const bool stays = std::all_of(positions.begin(), positions.end(),
                                   [&](const Floats3& frame) { return frame == positions.front(); });
    if (stays) positions.resize(1);
    return mesh;
  }

  /// The film coloured by that field, with one range for all frames.
  [[nodiscard]] Film coloured_by(Field field) const {
    Film film = view_.film;
    SceneRender& render = film.render;
    if (render.color_by != field) {
      render.color_map.reset();
      render.color_low.reset();
      render.color_high.reset();
    }
    render.color_by = field;
    render.color_range = RangeOver::kFilm;
    return film;
  }

  const CachedFilmView& view_;
  std::vector<int> frames_;
  Recording recording_;
  ViewerTake take_;
};

}  // namespace

std::vector<ViewerTake> viewer_takes(std::span<const CachedFilmView> views, const FrameRange& range) {
  std::deque<TakeMaker> makers;
  std::vector<Field> fields(kFields.begin(), kFields.end());
  for (const CachedFilmView& view : views) {
    makers.emplace_back(view, range.within(int(view.cache.frame_count())));
    makers.back().add_bodies();
    makers.back().add_springs();
    const Field wanted = makers.back().wanted();
    if (wanted != Field::kSkin && std::find(fields.begin(), fields.end(), wanted) == fields.end()) {
      fields.push_back(wanted);
    }
  }
  for (const Field field : fields) {
    ColorRanges common;
    for (const TakeMaker& maker : makers) {
      if (maker.has(field)) common = merged(common, maker.ranges_of(field));
    }
    for (TakeMaker& maker : makers) {
      if (maker.has(field)) maker.add_field(field, common);
    }
  }
  std::vector<ViewerTake> takes;
  takes.reserve(makers.size());
  for (TakeMaker& maker : makers) takes.push_back(maker.finish());
  return takes;
}

}  // namespace sprung
