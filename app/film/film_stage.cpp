#include "app/film/film_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/film/labels.h"
#include "app/film/overlays.h"
#include "core/appearance.h"
#include "core/bricks/embedding.h"
#include "core/world/make_soft_body.h"
#include "render/brick_cubes.h"

namespace sprung {
namespace {

const Eigen::Vector3f kNodeColor(0.20F, 0.22F, 0.26F);
const Eigen::Vector3f kEdgeColor(0.16F, 0.17F, 0.20F);
const Eigen::Vector3f kPinColor(0.90F, 0.24F, 0.12F);
const Eigen::Vector3f kContactColor(0.96F, 0.72F, 0.10F);
constexpr double kContactRadius = 0.16;  // of a brick
constexpr std::size_t kMaxContacts = 600;
constexpr double kSpringRadius = 0.014;  // at rest, of a brick
constexpr double kSpringGrowth = 2.5;    // of the radius, to the ends of the colours
constexpr double kOpaqueSpring = 0.25;   // of the stretch at the ends of the colours
constexpr double kMinStretch = 1e-6;     // at the ends of the colours
constexpr double kSmoothness = 0.1;      // pixels between a curved skin and its triangles
constexpr double kEdgeRadius = 0.35;     // pixels
constexpr double kShortEdge = 5;         // pixels; shorter ones are thinner, so that they do not blacken the skin
constexpr double kNodeRadius = 0.09;     // of a brick
constexpr double kPinRadius = 0.17;      // of a brick
constexpr double kTraceRadius = 0.0035;  // of the largest body
constexpr double kObstacleEdge = 0.08;   // of the largest body: light around a skin is known at its vertices
constexpr double kMaxEdges = 60;         // across an obstacle
constexpr double kFloorSize = 0.5;       // of the largest body: the most that a square or a board of the floor has
constexpr double kOutOfRange = 0.01;     // fraction of the springs that may exceed the range of colours

/// The default is blue in compression, red in tension, pale at rest.
ColorMap spring_colors(const SceneRender& render) { return render.color_map.value_or(ColorMap::kEmber); }

/// The opacity of a spring, given its stretch over that at the ends of the colours.
double spring_opacity(double share) {
  const double wanted = std::lerp(kOpacities.front(), 1.0, share / kOpaqueSpring);
  const auto more = std::find_if(kOpacities.begin() + 1, kOpacities.end(), [&](double o) { return o > wanted; });
  return *(more - 1);
}

int id_of(std::size_t body) { return int(body) + 1; }

template <class T>
std::shared_ptr<const T> not_owned(const T& object) {
  return {&object, [](const T*) {}};
}

Lighting lighting_of(const SceneRender& render, const std::optional<Environment>& environment) {
  Lighting lighting = lighting_of(render.light);
  if (environment && environment->sun) lighting = lit_by(*environment->sun, lighting);
  const SceneKeyLight& given = render.key_light;
  lighting.azimuth = given.azimuth.value_or(lighting.azimuth);
  lighting.elevation = given.elevation.value_or(lighting.elevation);
  if (given.size) lighting.key_radius = float(std::tan(*given.size * std::numbers::pi / 360));
  if (given.color) {
    lighting.key = lighting.key.mean() * srgb(*given.color).unaryExpr([](float c) { return linear_from_srgb(c); });
  }
  lighting.key *= float(given.strength);
  return lighting;
}

Points rows_of(const Points& nodes, const std::vector<int>& rows) { return nodes(rows, Eigen::all); }

}  // namespace

Eigen::Vector3f srgb(const Color& color) { return Eigen::Vector3f(color.red, color.green, color.blue) / 255.0F; }

SkinShape shape_of(const BrickGrid& grid, const Skin& skin, const Embedding& embedding, const Points& nodes,
                   SkinInterpolation interpolation) {
  if (interpolation == SkinInterpolation::kSmooth) {
    const SmoothEmbedding smooth(grid, nodes);
    return {.positions = smooth.points(embedding).cast<float>(),
            .normals = smooth.normals(embedding, skin.normals).cast<float>()};
  }
  return {.positions = deform_points(grid, embedding, nodes).cast<float>(),
          .normals = deform_normals(grid, embedding, skin.normals, nodes).cast<float>()};
}

SkinShape shape_of(const StageObstacle& obstacle, const Skin& skin, double time) {
  const Pose pose = pose_at(obstacle, time);
  const Points positions = (skin.positions * pose.rotation.transpose()).rowwise() + pose.translation.transpose();
  const Points normals = skin.normals * pose.rotation.transpose();
  return {.positions = positions.cast<float>(), .normals = normals.cast<float>()};
}

FilmStage::FilmStage(const Film& film, const Simulation& simulation, const Recording& recording, double pixel,
                     ColorRanges ranges)
    : film_(film),
      simulation_(simulation),
      recording_(recording),
      colors_(ranges.empty() || film.render.springs ? FieldColors(film, simulation, recording)
                                                    : FieldColors(film, simulation, recording, ranges)),
      pixel_(pixel) {
  const SceneRender& render = film.render;
  if (render.springs) stretches_ = ranges.empty() ? stretch_ranges() : std::move(ranges);
  for (std::size_t body = 0; body < simulation.world.bodies.size(); ++body) {
    if (render.bricks != BrickView::kNone) add_bricks(body);
    if (render.springs) add_springs(body);
    if (render.bricks == BrickView::kNone && !render.springs) add_skin(body);
    if (render.edges) add_edges(body);
    if (render.nodes) add_nodes(body);
    if (render.pins) add_pins(body);
    if (render.ghost) add_ghost(body);
  }
  int id = id_of(simulation.world.bodies.size());
  for (const StageObstacle& obstacle : simulation.obstacles) {
    if (obstacle.skin.positions.rows() > 0) add_obstacle(obstacle, id++);
  }
  for (std::size_t probe = 0; probe < recording.probes.size(); ++probe) {
    if (render.traces) add_trace(recording.probes[probe], probe_color(probe));
  }
  if (render.contacts) add_contacts();
}

Stage FilmStage::stage(const AlignedBox& bounds, const std::optional<Environment>& environment) const {
  Stage stage;
  for (const StageItem& item : items_) {
    stage.skins.push_back(item.skin.get());
    stage.default_colors.push_back(item.color);
    stage.looks.push_back(item.look);
    stage.mean_free_paths.push_back(item.mean_free_path);
    stage.ghosts.push_back(item.is_ghost);
    stage.ids.push_back(item.id);
  }
  stage.color_map = film_.render.springs ? spring_colors(film_.render) : colors_.map();
  const std::optional<double> ground = ground_height(simulation_.world.obstacles);
  stage.has_ground = ground && !film_.render.transparent && film_.render.floor != FloorKind::kNone;
  stage.floor =
      floor_of(film_.render.floor, film_.render.floor_size.value_or(round_length(kFloorSize * simulation_.size)));
  if (ground) stage.ground.height = *ground;
  stage.bounds = bounds;
  stage.lighting = lighting_of(film_.render, environment);
  stage.environment = environment;
  return stage;
}

FilmStage::Moment FilmStage::moment(std::size_t frame, double part) const {
  const std::size_t next = std::min(frame + 1, recording_.frames.size() - 1);
  Moment moment{frame, std::lerp(recording_.progress[frame], recording_.progress[next], part), {}};
  for (std::size_t body = 0; body < recording_.frames[frame].size(); ++body) {
    const Points from = recording_.frames[frame][body].cast<double>();
    if (part == 0) {
      moment.nodes.push_back(from);
    } else {
      moment.nodes.emplace_back((1 - part) * from + part * recording_.frames[next][body].cast<double>());
    }
  }
  return moment;
}

std::vector<SkinShape> FilmStage::shapes(std::size_t frame, double part) const {
  const Moment now = moment(frame, part);
  std::vector<SkinShape> shapes;
  for (const StageItem& item : items_) shapes.push_back(item.shape(now));
  return shapes;
}

ColorRanges FilmStage::color_ranges() const { return film_.render.springs ? stretches_ : colors_.ranges(); }

std::optional<Legend> FilmStage::legend(std::size_t frame) const {
  if (film_.render.springs) {
    const ColorRange& range = range_in(stretches_, frame);
    return Legend{.title = "Springs, %",
                  .map = spring_colors(film_.render),
                  .low = 100 * range.low,
                  .high = 100 * range.high,
                  .swatches = {}};
  }
  if (colors_.is_mapped()) return colors_.legend(frame);
  return std::nullopt;
}

Eigen::VectorXd FilmStage::map_coordinates(const Moment& moment, std::size_t body) const {
  return colors_.is_mapped() && !film_.render.springs ? colors_.map_coordinates(moment.frame, body) : Eigen::VectorXd();
}

/// The edges drawn are those of the mesh's own triangles.
bool FilmStage::is_smooth() const { return film_.render.smooth && !film_.render.edges && std::isfinite(pixel_); }

FilmStage::DrawnSkin FilmStage::drawn_skin(const SoftBody& body) {
  if (!is_smooth() || body.drawn.mesh == nullptr) {
    return {not_owned(body.drawn.skin), not_owned(body.drawn.embedding)};
  }
  const auto [entry, is_new] = smooth_.try_emplace(body.drawn.mesh.get());
  if (is_new) {
    const auto smooth = std::make_shared<const EmbeddedSkin>(smooth_skin(body, kSmoothness * pixel_));
    entry->second = {{smooth, &smooth->skin}, {smooth, &smooth->embedding}};
  }
  return entry->second;
}

void FilmStage::add_skin(std::size_t row) {
  const SoftBody& body = simulation_.world.bodies[row];
  const SceneBody& scene_body = film_.bodies[simulation_.origins[row].body];
  const DrawnSkin drawn = drawn_skin(body);
  const Color color = color_of(scene_body, *film_.library).value_or(body.drawn.color);
  items_.push_back(
      {drawn.skin, srgb(color), colors_.is_mapped() ? Look::kChart : look_of(scene_body, *film_.library), false,
       id_of(row),
       [this, row, &body, drawn, interpolation = scene_body.skin](const Moment& now) {
         SkinShape shape = shape_of(body.grid, *drawn.skin, *drawn.embedding, now.nodes[row], interpolation);
         const Eigen::VectorXd of_nodes = map_coordinates(now, row);
         if (of_nodes.size() > 0) {
           shape.map_coordinates =
               interpolate(body.grid, *drawn.embedding, of_nodes).cwiseMax(0.0).cwiseMin(1.0).cast<float>();
         }
         return shape;
       },
       colors_.is_mapped() ? 0 : mean_free_path_of(scene_body, *film_.library)});
}

void FilmStage::add_bricks(std::size_t row) {
  const Body& body = simulation_.world.bodies[row];
  const bool exploded = film_.render.bricks == BrickView::kExploded;
  const Eigen::Vector3f color = colors_.is_mapped() && !film_.render.springs
                                    ? Eigen::Vector3f::Ones().eval()
                                    : srgb(simulation_.world.bodies[row].drawn.color);
  const auto cubes = std::make_shared<const BrickCubes>(body.grid, bricks_left(body.grid, film_.render.cut), exploded,
                                                        std::vector(body.grid.cells.size(), color));
  const auto skin = std::make_shared<const Skin>(with_shape(cubes->skin(), cubes->shape(body.rest_positions)));
  items_.push_back(
      {skin, color, colors_.is_mapped() ? Look::kChart : Look::kRubber, false, id_of(row),
       [this, row, cubes](const Moment& now) { return cubes->shape(now.nodes[row], map_coordinates(now, row)); }});
}

void FilmStage::add_springs(std::size_t row) {
  const Body& body = simulation_.world.bodies[row];
  const auto springs = std::make_shared<const SpringSet>(springs_of(body, bricks_left(body.grid, film_.render.cut)));
  const auto rods = std::make_shared<const Rods>(springs->nodes.size(), kSpringRadius * body.grid.brick_size);
  const auto shape = [this, springs, rods](const Points& nodes, std::size_t frame) {
    const auto [low, high] = range_in(stretches_, frame);
    const Eigen::VectorXd coordinates = ((springs->stretches(nodes).array() - low) / (high - low)).max(0.0).min(1.0);
    const Eigen::VectorXd shares = 2 * (coordinates.array() - 0.5).abs();
    return rods->between(nodes, springs->nodes,
                         {.coordinates = coordinates,
                          .widths = 1 + kSpringGrowth * shares.array(),
                          .opacities = shares.unaryExpr(&spring_opacity)});
  };
  const auto skin = std::make_shared<const Skin>(with_shape(rods->skin(), shape(body.rest_positions, 0)));
  items_.push_back({skin, Eigen::Vector3f::Ones(), Look::kChart, false, id_of(row),
                    [row, shape](const Moment& now) { return shape(now.nodes[row], now.frame); }});
}

/// Symmetric; over all frames, so that colours mean the same in each, or by frame.
ColorRanges FilmStage::stretch_ranges() const {
  if (const std::optional<double>& stated = film_.render.color_high) return {{-*stated, *stated}};
  ColorRanges ranges(recording_.frames.size(), {-kMinStretch, kMinStretch});
  for (std::size_t row = 0; row < simulation_.world.bodies.size(); ++row) {
    const Body& body = simulation_.world.bodies[row];
    const SpringSet springs = springs_of(body, std::vector<bool>(body.grid.cells.size(), true));
    for (std::size_t frame = 0; frame < ranges.size(); ++frame) {
      Eigen::VectorXd stretches = springs.stretches(recording_.frames[frame][row].cast<double>()).cwiseAbs();
      const auto rank = Eigen::Index(kOutOfRange * double(stretches.size()));
      std::nth_element(stretches.begin(), stretches.end() - 1 - rank, stretches.end());
      const double furthest = std::max(ranges[frame].high, stretches[stretches.size() - 1 - rank]);
      ranges[frame] = {-furthest, furthest};
    }
  }
  if (has_range_per_frame(film_.render)) return ranges;
  const auto is_less = [](const ColorRange& a, const ColorRange& b) { return a.high < b.high; };
  return {*std::max_element(ranges.begin(), ranges.end(), is_less)};
}

/// Adds the edges of the triangles of a body's skin.
void FilmStage::add_edges(std::size_t row) {
  const SoftBody& body = simulation_.world.bodies[row];
  const std::vector<std::array<int, 2>> edges = edges_of(body.drawn.skin.triangles);
  const double pixel = std::isfinite(pixel_) ? pixel_ : 0;
  const auto rods = std::make_shared<const Rods>(edges.size(), kEdgeRadius * pixel);
  Eigen::VectorXd widths(edges.size());
  for (Eigen::Index i = 0; i < widths.size(); ++i) {
    const auto way = body.drawn.skin.positions.row(edges[i][0]) - body.drawn.skin.positions.row(edges[i][1]);
    widths[i] = pixel > 0 ? std::min(1.0, way.norm() / (kShortEdge * pixel)) : 0;
  }
  const auto shape = [&body, rods, edges, widths,
                      interpolation = film_.bodies[simulation_.origins[row].body].skin](const Points& nodes) {
    const SkinShape skin = shape_of(body.grid, body.drawn.skin, body.drawn.embedding, nodes, interpolation);
    return rods->between(skin.positions.cast<double>(), edges, {.widths = widths});
  };
  const auto skin = std::make_shared<const Skin>(with_shape(rods->skin(), shape(body.rest_positions)));
  items_.push_back({skin, kEdgeColor, Look::kChart, false, id_of(row),
                    [row, shape](const Moment& now) { return shape(now.nodes[row]); }});
}

void FilmStage::add_balls(std::size_t body, std::vector<int> nodes, double radius, const Eigen::Vector3f& color) {
  const auto balls = std::make_shared<const Balls>(nodes.size(), radius);
  const Points& rest = simulation_.world.bodies[body].rest_positions;
  const auto skin = std::make_shared<const Skin>(with_shape(balls->skin(), balls->shape(rows_of(rest, nodes))));
  items_.push_back(
      {skin, color, Look::kPlastic, false, id_of(body), [body, balls, nodes = std::move(nodes)](const Moment& now) {
         return balls->shape(rows_of(now.nodes[body], nodes));
       }});
}

void FilmStage::add_nodes(std::size_t body) {
  const BrickGrid& grid = simulation_.world.bodies[body].grid;
  const std::vector<bool> shown = bricks_left(grid, film_.render.cut);
  std::vector<int> nodes;
  for (std::size_t brick = 0; brick < shown.size(); ++brick) {
    if (shown[brick]) nodes.insert(nodes.end(), grid.nodes[brick].begin(), grid.nodes[brick].end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  add_balls(body, nodes, kNodeRadius * grid.brick_size, kNodeColor);
}

void FilmStage::add_pins(std::size_t body) {
  const std::vector<int> nodes = simulation_.origins[body].pinned_nodes();
  if (nodes.empty()) return;
  add_balls(body, nodes, kPinRadius * simulation_.world.bodies[body].grid.brick_size, kPinColor);
}

void FilmStage::add_ghost(std::size_t row) {
  const SoftBody& body = simulation_.world.bodies[row];
  const DrawnSkin drawn = drawn_skin(body);
  SkinShape shape = shape_of(body.grid, *drawn.skin, *drawn.embedding, body.rest_positions);
  items_.push_back({drawn.skin, srgb(body.drawn.color), Look::kRubber, true, id_of(row),
                    [shape = std::move(shape)](const Moment&) -> SkinShape { return SkinShape(shape); }});
}

void FilmStage::add_obstacle(const StageObstacle& obstacle, int id) {
  Skin fine = obstacle.skin;
  if (is_smooth()) refine_curves(fine, kSmoothness * pixel_);
  refine(fine, std::max(kObstacleEdge * simulation_.size, bounding_box(fine.positions).diagonal().norm() / kMaxEdges));
  const auto skin = std::make_shared<const Skin>(std::move(fine));
  items_.push_back({skin, srgb(obstacle.color), Look::kPlastic, false, id,
                    [&obstacle, skin](const Moment& now) { return shape_of(obstacle, *skin, now.time); }});
}

void FilmStage::add_contacts() {
  const auto contacts = std::make_shared<const Contacts>(simulation_);
  const double brick = simulation_.world.bodies.front().grid.brick_size;
  const auto balls = std::make_shared<const Balls>(kMaxContacts, kContactRadius * brick);
  const auto shape = [contacts, balls](const Moment& now) {
    return balls->shape(contacts->at(now.nodes, now.time), now.nodes.front().row(0).transpose());
  };
  const auto skin = std::make_shared<const Skin>(with_shape(balls->skin(), shape(moment(0, 0))));
  items_.push_back({skin, kContactColor, Look::kPlastic, false, 0, shape});
}

/// The path of the probe up to the current frame.
void FilmStage::add_trace(const ProbeTrack& track, const Eigen::Vector3f& color) {
  if (track.samples.size() < 2) return;
  const auto rods = std::make_shared<const Rods>(track.samples.size() - 1, kTraceRadius * simulation_.size);
  const auto shape = [rods, &track](std::size_t frame) {
    const Eigen::Index count = track.samples.size() - 1;
    Points from(count, 3);
    Points to(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t row = i;
      from.row(i) = track.samples[std::min(row, frame)].position.transpose();
      to.row(i) = track.samples[std::min(row + 1, frame)].position.transpose();
    }
    return rods->shape(from, to);
  };
  const auto skin = std::make_shared<const Skin>(with_shape(rods->skin(), shape(track.samples.size() - 1)));
  items_.push_back({skin, color, Look::kPlastic, false, 0, [shape](const Moment& now) { return shape(now.frame); }});
}

}  // namespace sprung
