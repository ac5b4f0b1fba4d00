#include "app/film/field_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "core/body/brick_measures.h"
#include "core/body/stress.h"

namespace sprung {
namespace {

Eigen::VectorXd measured(BrickMeasure measure, const Body& body, const Points& positions) {
  return node_means(body.grid, measure_bricks(body, measure, positions));
}

/// Central differences; one-sided at the ends of the film.
Eigen::VectorXd speeds(const Recording& recording, std::size_t frame, std::size_t actor, double fps) {
  const std::size_t last = recording.frames.size() - 1;
  const std::size_t from = frame > 0 ? frame - 1 : 0;
  const std::size_t to = std::min(frame + 1, last);
  const auto& frames = recording.frames;
  if (from == to) return Eigen::VectorXd::Zero(frames[frame][actor].rows());
  const Floats3 way = frames[to][actor] - frames[from][actor];
  return way.rowwise().norm().cast<double>() * (fps / double(to - from));
}

}  // namespace

Eigen::VectorXd field_values(Field field, const Simulation& simulation, const Recording& recording, std::size_t frame,
                             std::size_t actor, double fps, StrainMeasure measure) {
  const Body& body = simulation.world.bodies[actor];
  const Points positions = recording.frames[frame][actor].cast<double>();
  switch (field) {
    case Field::kSkin:
      break;
    case Field::kDisplacement:
      return (positions - body.rest_positions).rowwise().norm();
    case Field::kSpeed:
      return speeds(recording, frame, actor, fps);
    case Field::kStretch:
      return measured(BrickMeasure::kStretch, body, positions);
    case Field::kStrain:
      return measured(BrickMeasure::kStrain, body, positions);
    case Field::kStress:
      return von_mises(recover_stress(body, positions, measure));
    case Field::kVolume:
      return measured(BrickMeasure::kVolume, body, positions);
    case Field::kFill:
      return node_means(body.grid, Eigen::Map<const Eigen::VectorXd>(body.grid.fill.data(), body.grid.brick_count()));
    case Field::kRegion:
      return node_means(body.grid, brick_youngs(body));
  }
  return Eigen::VectorXd::Zero(positions.rows());
}

bool is_moving(Field field) { return field != Field::kSkin && field != Field::kFill && field != Field::kRegion; }

namespace {

constexpr double kUtmost = 0.005;             // fraction of all values that may be outside the range at each end
constexpr std::size_t kMostValues = 4 << 20;  // that are sampled

struct Unit {
  double from;  // SI, smallest range shown in this unit
  double size;  // SI
  const char* name;
};

struct FieldWords {
  const char* name;
  ColorMap map;
  std::array<Unit, 4> units;  // from large to small
};

constexpr Unit kEnd{-std::numeric_limits<double>::infinity(), 1, ""};

FieldWords words_of(Field field) {
  const std::array<Unit, 4> lengths{{{1, 1, "m"}, {0.02, 0.01, "cm"}, {2e-4, 1e-3, "mm"}, {kEnd.from, 1e-6, "um"}}};
  const std::array<Unit, 4> speeds{{{0.5, 1, "m/s"}, {5e-3, 0.01, "cm/s"}, {kEnd.from, 1e-3, "mm/s"}, kEnd}};
  const std::array<Unit, 4> pressures{{{1e9, 1e9, "GPa"}, {1e6, 1e6, "MPa"}, {1e3, 1e3, "kPa"}, {kEnd.from, 1, "Pa"}}};
  const std::array<Unit, 4> shares{{{kEnd.from, 0.01, "%"}, kEnd, kEnd, kEnd}};
  const std::array<Unit, 4> none{{kEnd, kEnd, kEnd, kEnd}};
  switch (field) {
    case Field::kSkin:
      break;
    case Field::kDisplacement:
      return {"Displacement", ColorMap::kViridis, lengths};
    case Field::kSpeed:
      return {"Speed", ColorMap::kViridis, speeds};
    case Field::kStretch:
      return {"Stretch", ColorMap::kViridis, none};
    case Field::kStrain:
      return {"Strain", ColorMap::kViridis, shares};
    case Field::kStress:
      return {"Stress", ColorMap::kViridis, pressures};
    case Field::kVolume:
      return {"Volume", ColorMap::kCoolwarm, shares};
    case Field::kFill:
      return {"Fill", ColorMap::kCividis, shares};
    case Field::kRegion:
      return {"Young's modulus", ColorMap::kViridis, pressures};
  }
  return {"", ColorMap::kViridis, none};
}

/// The quantiles of that share and of one minus it.
std::pair<double, double> extremes(std::vector<double>& values) {
  const auto rank = std::ptrdiff_t(kUtmost * double(values.size()));
  const auto low = values.begin() + rank;
  std::nth_element(values.begin(), low, values.end());
  const double lowest = *low;
  const auto high = values.end() - 1 - rank;
  std::nth_element(values.begin(), high, values.end());
  return {lowest, *high};
}

}  // namespace

FieldColors::FieldColors(const Film& scene, const Simulation& simulation, const Recording& recording)
    : field_(scene.render.color_by),
      map_(scene.render.color_map.value_or(words_of(field_).map)),
      simulation_(simulation),
      recording_(recording),
      fps_(scene.fps),
      measure_(strain_measure(scene)) {
  if (!is_mapped()) return;
  const SceneRender& render = scene.render;
  if (!render.color_low || !render.color_high) find_range();
  low_ = render.color_low.value_or(low_);
  high_ = render.color_high.value_or(high_);
  if (high_ <= low_) high_ = low_ + std::max(1e-6, 1e-3 * std::abs(low_));
}

void FieldColors::find_range() {
  const std::size_t frames = is_moving(field_) ? recording_.frames.size() : 1;
  std::size_t count = 0;
  for (const SoftBody& actor : simulation_.world.bodies) count += std::size_t(actor.node_count());
  const std::size_t stride = 1 + frames * count / kMostValues;
  std::vector<double> values;
  values.reserve(frames * count / stride + frames);
  std::size_t next = 0;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t actor = 0; actor < simulation_.world.bodies.size(); ++actor) {
      const Eigen::VectorXd of_actor = field_values(field_, simulation_, recording_, frame, actor, fps_, measure_);
      const std::size_t size = of_actor.size();
      for (; next < size; next += stride) values.push_back(of_actor[next]);
      next -= size;
    }
  }
  std::tie(low_, high_) = extremes(values);
  switch (field_) {
    case Field::kVolume: {  // symmetric about the rest volume, the middle of the map
      const double reach = std::max(std::abs(high_ - 1), std::abs(1 - low_));
      low_ = 1 - reach;
      high_ = 1 + reach;
      break;
    }
    case Field::kStretch:
      low_ = std::min(low_, 1.0);
      break;
    case Field::kFill:
      low_ = 0;
      high_ = 1;
      break;
    case Field::kRegion:
      break;
    default:
      low_ = 0;
  }
}

Eigen::VectorXd FieldColors::map_coordinates(std::size_t frame, std::size_t actor) const {
  const Eigen::VectorXd values = field_values(field_, simulation_, recording_, frame, actor, fps_, measure_);
  return (values.array() - low_) / (high_ - low_);
}

Legend FieldColors::legend() const {
  const FieldWords words = words_of(field_);
  const double range = std::max(std::abs(low_), std::abs(high_));
  const Unit unit = *std::find_if(words.units.begin(), words.units.end(),
                                  [&](const Unit& candidate) { return range >= candidate.from; });
  const bool has_name = unit.name[0] != '\0';
  return {.title = has_name ? fmt::format("{}, {}", words.name, unit.name) : words.name,
          .map = map_,
          .low = low_ / unit.size,
          .high = high_ / unit.size,
          .swatches = {}};
}

}  // namespace sprung
