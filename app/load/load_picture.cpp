#include "app/load/load_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/film/film_stage.h"
#include "core/body/stress.h"
#include "core/simulation/selector.h"
#include "core/units.h"
#include "render/image/legend.h"

namespace sprung {
namespace {

const Eigen::Vector3f kGhostColor(0.55F, 0.58F, 0.62F);
const Eigen::Vector3f kLoadColor(0.10F, 0.22F, 0.62F);
const Eigen::Vector3f kSupportColor(0.16F, 0.46F, 0.24F);
const Eigen::Vector3f kWorstColor(0.08F, 0.08F, 0.09F);
constexpr Ink kInk{30, 32, 36};
constexpr double kVisible = 0.07;  // of the longest side: the largest displacement, as drawn
constexpr double kArrow = 0.16;    // of the longest side
constexpr double kCone = 0.045;
constexpr double kBall = 0.011;
constexpr double kApart = 0.13;  // symbols on a face
constexpr std::size_t kMaxSymbols = 12;
constexpr double kUtmost = 0.002;  // of the stresses that may lie beyond the colours if the peak is singular
constexpr double kAzimuth = 35;
constexpr double kElevation = 22;
constexpr int kDirections = 8;      // to look from
constexpr double kFromBelow = 0.6;  // factor on a direction's score
constexpr double kForText = 0.09;   // of the picture's width, at its left edge
constexpr int kStops = 24;          // of a turntable, from which everything has to be in view

/// 1, 2 or 5 times a power of ten, at most `most`; 1 if that is less than 2.
double round_magnification(double most) { return most < 2 ? 1 : round_length(most); }

}  // namespace

LoadPicture::LoadPicture(const PartReport& report, const PartSolution& solution, int width, int height)
    : report_(report), solution_(solution), width_(width), height_(height), longest_(report.answer.extent.maxCoeff()) {
  magnification_ = round_magnification(kVisible * longest_ / report.answer.displacement.value);
  skins_.reserve(8 + 2 * solution.simulation.world.bodies.size());
  add_bodies();
  add_supports();
  add_loads();
  add_worst_place();
  stage_.color_map = ColorMap::kTurbo;
  stage_.has_ground = false;
  for (const Skin& skin : skins_) stage_.bounds.extend(bounding_box(skin.positions));
  middle_ = stage_.bounds.center();
  std::vector<const Triangles*> triangles;
  for (const SoftBody& body : solution.simulation.world.bodies) triangles.push_back(&body.drawn.skin.triangles);
  sight_.emplace(drawn_, triangles);
  choose_direction();
  add_axes();
  for (const Skin& skin : skins_) stage_.skins.push_back(&skin);
}

void LoadPicture::add(Skin skin, const Eigen::Vector3f& color, bool is_ghost) {
  shapes_.push_back({.positions = skin.positions.cast<float>(), .normals = skin.normals.cast<float>()});
  skins_.push_back(std::move(skin));
  stage_.default_colors.push_back(color);
  stage_.looks.push_back(is_ghost ? Look::kRubber : Look::kPlastic);
  stage_.ghosts.push_back(is_ghost);
}

void LoadPicture::add_bodies() {
  std::vector<Eigen::VectorXd> stresses;
  std::vector<double> all;
  for (const SoftBody& body : solution_.simulation.world.bodies) {
    const Points nodes = body.rest_positions + magnification_ * (body.positions - body.rest_positions);
    Skin skin = body.drawn.skin;
    SkinShape shape = shape_of(body.grid, body.drawn.skin, body.drawn.embedding, nodes);
    skin.positions = shape.positions.cast<double>();
    skin.normals = shape.normals.cast<double>();
    drawn_.push_back(skin.positions);
    at_rest_.push_back(part_from_world(solution_, report_.part, body.skin_positions(body.rest_positions)));
    stresses.push_back(von_mises(skin_stress(solution_, body)));
    all.insert(all.end(), stresses.back().begin(), stresses.back().end());
    add(std::move(skin), Eigen::Vector3f::Ones(), false);
    stage_.looks.back() = Look::kChart;
  }
  const auto last = all.end() - 1 - std::ptrdiff_t(kUtmost * double(all.size()));
  std::nth_element(all.begin(), last, all.end());
  highest_ = report_.answer.von_mises ? report_.answer.von_mises->value : *last;
  for (std::size_t row = 0; row < stresses.size(); ++row) {
    shapes_[row].map_coordinates = (stresses[row] / std::max(highest_, 1e-300)).cwiseMin(1.0).cast<float>();
  }
  for (const SoftBody& body : solution_.simulation.world.bodies) {
    const SkinShape rest = shape_of(body.grid, body.drawn.skin, body.drawn.embedding, body.rest_positions);
    Skin skin = body.drawn.skin;
    skin.positions = rest.positions.cast<double>();
    skin.normals = rest.normals.cast<double>();
    add(std::move(skin), kGhostColor, true);
  }
}

std::vector<LoadPicture::Spot> LoadPicture::spots_on(const PartFace& face) const {
  const Selector selector(report_.part.loaded);
  std::vector<Spot> candidates;
  for (std::size_t row = 0; row < drawn_.size(); ++row) {
    const Triangles& triangles = solution_.simulation.world.bodies[row].drawn.skin.triangles;
    for (const SkinPiece& piece : selector.skin_pieces(face.selection, at_rest_[row], triangles, row)) {
      const auto corner = [&](int k) -> Vec3 { return drawn_[row].row(triangles(piece.triangle, k)); };
      const Vec3 outward = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      if (piece.share() < 0.3 || !(outward.norm() > 0)) continue;
      candidates.push_back({(corner(0) + corner(1) + corner(2)) / 3, outward.normalized()});
    }
  }
  // The one furthest from those chosen comes next.
  std::vector<Spot> spots;
  std::vector<double> distances(candidates.size(), 1e300);
  while (spots.size() < kMaxSymbols && !candidates.empty()) {
    const auto next = std::max_element(distances.begin(), distances.end()) - distances.begin();
    if (!spots.empty() && distances[next] < kApart * longest_) break;
    spots.push_back(candidates[next]);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      distances[i] = std::min(distances[i], (candidates[i].position - spots.back().position).norm());
    }
  }
  return spots;
}

void LoadPicture::add_supports() {
  Symbols symbols;
  for (const PartFix& fix : report_.loads.fixes) {
    for (const Spot& spot : spots_on(fix.face)) {
      const Vec3 along = -kCone * longest_ * spot.outward;
      symbols.add_cone(spot.position - along, along, 0.4 * kCone * longest_);
    }
  }
  if (!symbols.empty()) add(symbols.skin(), kSupportColor, false);
}

void LoadPicture::add_loads() {
  Symbols symbols;
  const double length = kArrow * longest_;
  const auto add_arrow = [&](const Vec3& position, const Vec3& way, bool comes, int heads) {
    symbols.add_arrow(comes ? position - way : position, comes ? position : Vec3(position + way), heads);
  };
  for (const PartLoad& load : report_.loads.loads) {
    const Vec3 way = length * (report_.part.world_from_file * load.direction);
    const int heads = load.dimension == Dimension::kTorque ? 2 : 1;
    if (!load.face) {
      Vec3 centre = Vec3::Zero();
      for (const Points& skin : drawn_) centre += skin.colwise().mean().transpose() / double(drawn_.size());
      add_arrow(centre, 2 * way, false, heads);
      continue;
    }
    std::vector<Spot> spots = spots_on(*load.face);
    if (heads == 2 && spots.size() > 1) {
      Vec3 centre = Vec3::Zero();
      for (const Spot& spot : spots) centre += spot.position / double(spots.size());
      spots = {{centre, spots.front().outward}};
    }
    for (const Spot& spot : spots) {
      const Vec3 here = load.dimension == Dimension::kPressure ? Vec3(-length * spot.outward) : way;
      add_arrow(spot.position, here, here.dot(spot.outward) < -0.1 * length, heads);
    }
  }
  if (!symbols.empty()) add(symbols.skin(), kLoadColor, false);
}

void LoadPicture::add_worst_place() {
  if (!report_.answer.von_mises) return;
  const Vec3 position = report_.part.rest_from_file(report_.answer.von_mises->position);
  double nearest = 1e300;
  for (std::size_t row = 0; row < drawn_.size(); ++row) {
    Eigen::Index vertex = 0;
    const double distance = (at_rest_[row].rowwise() - position.transpose()).rowwise().squaredNorm().minCoeff(&vertex);
    if (distance >= nearest) continue;
    nearest = distance;
    worst_ = Spot{drawn_[row].row(vertex), skins_[row].normals.row(vertex).normalized()};
  }
  Symbols symbols;
  symbols.add_ball(worst_->position, kBall * longest_);
  add(symbols.skin(), kWorstColor, false);
}

namespace {

Legend legend_of(double highest) {
  const char* unit = highest >= 1e9 ? "GPa" : highest >= 1e6 ? "MPa" : highest >= 1e3 ? "kPa" : "Pa";
  const double size = highest >= 1e9 ? 1e9 : highest >= 1e6 ? 1e6 : highest >= 1e3 ? 1e3 : 1;
  return {.title = fmt::format("Stress, {}", unit),
          .map = ColorMap::kTurbo,
          .low = 0,
          .high = highest / size,
          .swatches = {}};
}

Vec3 towards_viewer(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180;
  const double e = elevation * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

}  // namespace

bool LoadPicture::is_seen(const Spot& spot, const Vec3& viewer) const {
  return sight_->is_open(spot.position, spot.outward, viewer);
}

/// The direction that shows most of the largest stress, the loads and the supports; from below if that shows much more.
void LoadPicture::choose_direction() {
  std::vector<std::pair<double, Spot>> seen;  // with its score
  if (worst_) seen.emplace_back(2, *worst_);
  const auto add = [&](const PartFace& face, double worth) {
    const std::vector<Spot> spots = spots_on(face);
    for (const Spot& spot : spots) seen.emplace_back(worth / double(spots.size()), spot);
  };
  for (const PartLoad& load : report_.loads.loads) {
    if (load.face) add(*load.face, 1);
  }
  for (const PartFix& fix : report_.loads.fixes) add(fix.face, 0.5);
  double best = -1e300;
  for (const double elevation : {kElevation, -kElevation}) {
    for (int step = 0; step < kDirections; ++step) {
      const double azimuth = kAzimuth + 360.0 * step / kDirections;
      double score = (elevation < 0 ? -kFromBelow : 0) - 0.02 * step;
      for (const auto& [worth, spot] : seen) {
        if (is_seen(spot, towards_viewer(azimuth, elevation))) score += worth;
      }
      if (score <= best) continue;
      best = score;
      azimuth_ = azimuth;
      elevation_ = elevation;
    }
  }
}

Camera LoadPicture::framed(bool turns) const {
  std::vector<Vec3> seen;
  for (std::size_t item = 0; item + 1 < skins_.size(); ++item) {  // the last are the axes
    const Skin& skin = skins_[item];
    const auto step = std::max<Eigen::Index>(1, skin.positions.rows() / (turns ? 400 : 4000));
    for (Eigen::Index row = 0; row < skin.positions.rows(); row += step) {
      const Vec3 arm = Vec3(skin.positions.row(row)) - middle_;
      for (int stop = 0; stop < (turns ? kStops : 1); ++stop) {
        const Eigen::AngleAxisd turn(2 * std::numbers::pi * stop / kStops, Vec3::UnitY());
        seen.emplace_back(middle_ + turn * arm);
      }
    }
  }
  Points points(isize(seen), 3);
  for (int row = 0; row < isize(seen); ++row) points.row(row) = seen[row].transpose();
  const double right = legend_width(legend_of(highest_), height_, Font()) / width_;
  Camera camera = frame_points(points, (1 - kForText - right) * width_ / height_, azimuth_, elevation_);
  camera.shift = kForText - right;
  return camera;
}

void LoadPicture::write_labels(Image& image, const Camera& camera) const {
  const Font font;
  draw_legend(image, legend_of(highest_), font);
  const double size = letters_height(image.height);
  const double margin = kLabelMargin * image.height;
  const PartAnswer& answer = report_.answer;
  std::vector<std::string> lines{fmt::format("{}, {}", report_.part.loaded.name, report_.part.body.material.name)};
  for (const PartLoad& load : report_.loads.loads) {
    lines.push_back(fmt::format("{}: {}", load.face ? load.face->name : load.text, load.description()));
  }
  lines.push_back(fmt::format(
      "moves {}{}; grey: without load", readable(answer.displacement.value, Dimension::kLength),
      magnification_ == 1 ? std::string(", drawn as it is") : fmt::format(", drawn {:g} times", magnification_)));
  if (report_.verdict.safety) lines.push_back("safety " + safety_text(report_.verdict));
  for (std::size_t line = 0; line < lines.size(); ++line) {
    font.write(image, margin, margin + (1.25 * double(line) + 0.8) * size, size, lines[line], kInk);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector2d at = projected(axis_tips_[axis], camera);
    font.write(image, at.x() - 0.3 * size, at.y() + 0.3 * size, size, std::string(1, "xyz"[axis]), kInk);
  }
  if (!worst_ || !is_seen(*worst_, (camera.eye - worst_->position).normalized())) return;
  const Eigen::Vector2d at = projected(worst_->position, camera);
  const std::string text = readable(answer.von_mises->value, Dimension::kPressure);
  const double left = std::clamp(at.x() + 0.6 * size, 0.0, image.width - font.width(text, size));
  font.write(image, left, at.y() - 0.4 * size, size, text, kInk);
}

namespace {

/// Columns: right, up and forward; unit.
Mat3 axes_of(const Camera& camera) {
  Mat3 axes;
  axes.col(2) = (camera.target - camera.eye).normalized();
  axes.col(0) = axes.col(2).cross(camera.up).normalized();
  axes.col(1) = axes.col(0).cross(axes.col(2));
  return axes;
}

double slope_of(const Camera& camera) { return std::tan(camera.vertical_field_of_view * std::numbers::pi / 360); }

}  // namespace

void LoadPicture::add_axes() {
  Symbols symbols;
  for (Eigen::Index axis = 0; axis < 3; ++axis) symbols.add_arrow(Vec3::Zero(), report_.part.world_from_file.col(axis));
  axes_ = symbols.points();
  add(symbols.skin(), kGhostColor, false);
}

void LoadPicture::place_axes(const Camera& camera) {
  constexpr double kLeft = -0.85;  // of half the picture
  constexpr double kDown = -0.74;
  constexpr double kLength = 0.15;
  const Mat3 axes = axes_of(camera);
  const double depth = (camera.target - camera.eye).norm();
  const double half = slope_of(camera) * depth;  // m, of the picture's height there
  const Vec3 origin = camera.eye + axes * Vec3((kLeft - camera.shift) * half * width_ / height_, kDown * half, depth);
  const double length = kLength * half;
  shapes_.back().positions = ((length * axes_).rowwise() + origin.transpose()).cast<float>();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axis_tips_[axis] = origin + 1.25 * length * report_.part.world_from_file.col(Eigen::Index(axis));
  }
}

Eigen::Vector2d LoadPicture::projected(const Vec3& position, const Camera& camera) const {
  const Vec3 arm = axes_of(camera).transpose() * (position - camera.eye);
  const double half = slope_of(camera) * arm.z();
  return {(1 + arm.x() / (half * width_ / height_) + camera.shift) / 2 * width_, (1 - arm.y() / half) / 2 * height_};
}

Image LoadPicture::draw(const Camera& camera) {
  if (!renderer_) {
    renderer_ = std::make_unique<Renderer>(stage_, RenderOptions{.width = width_, .height = height_, .samples = 4});
  }
  place_axes(camera);
  Image image = renderer_->draw(shapes_, camera);
  write_labels(image, camera);
  return image;
}

Image LoadPicture::draw() { return draw(framed(false)); }

Image LoadPicture::draw_turned(double degrees) { return draw(carried_around(framed(true), middle_, degrees)); }

}  // namespace sprung
