#include "app/film/field_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/body/brick_measures.h"
#include "core/body/stress.h"

namespace sprung {
namespace {

Eigen::VectorXd measured(BrickMeasure measure, const Body& body, const Points& positions) {
  return node_means(body.grid, measure_bricks(body, measure, positions));
}

/// Central differences; one-sided at the ends of the film.
Eigen::VectorXd speeds(const Recording& recording, std::size_t frame, std::size_t body, double fps) {
  const std::size_t last = recording.frames.size() - 1;
  const std::size_t from = frame > 0 ? frame - 1 : 0;
  const std::size_t to = std::min(frame + 1, last);
  const auto& frames = recording.frames;
  if (from == to) return Eigen::VectorXd::Zero(frames[frame][body].rows());
  const Floats3 way = frames[to][body] - frames[from][body];
  return way.rowwise().norm().cast<double>() * (fps / double(to - from));
}

}  // namespace

Eigen::VectorXd field_values(Field field, const Simulation& simulation, const Recording& recording, std::size_t frame,
                             std::size_t row, double fps, StrainMeasure measure) {
  const Body& body = simulation.world.bodies[row];
  const Points positions = recording.frames[frame][row].cast<double>();
  switch (field) {
    case Field::kSkin:
      break;
    case Field::kDisplacement:
      return (positions - body.rest_positions).rowwise().norm();
    case Field::kSpeed:
      return speeds(recording, frame, row, fps);
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

constexpr double kUtmost = 0.005;            // fraction of all values that may be outside the range at each end
constexpr std::size_t kMaxValues = 4 << 20;  // that are sampled

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

const ColorRange& range_in(const ColorRanges& ranges, std::size_t frame) {
  return ranges[std::min(frame, ranges.size() - 1)];
}

ColorRanges merged(const ColorRanges& a, const ColorRanges& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  ColorRanges both;
  for (std::size_t frame = 0; frame < std::max(a.size(), b.size()); ++frame) {
    const ColorRange& one = range_in(a, frame);
    const ColorRange& other = range_in(b, frame);
    both.push_back({std::min(one.low, other.low), std::max(one.high, other.high)});
  }
  return both;
}

bool has_range_per_frame(const SceneRender& render) { return render.color_range == RangeOver::kFrame && !render.sheet; }

FieldColors::FieldColors(const Film& film, const Simulation& simulation, const Recording& recording)
    : FieldColors(film, simulation, recording, ColorRanges()) {
  if (!is_mapped()) return;
  const SceneRender& render = film.render;
  const std::size_t frames = is_moving(field_) ? recording.frames.size() : 1;
  const std::size_t each = has_range_per_frame(render) ? 1 : frames;
  for (std::size_t first = 0; first < frames; first += each) {
    const bool is_stated = render.color_low && render.color_high;
    const ColorRange found = is_stated ? ColorRange{} : range_over(first, first + each);
    ColorRange range{render.color_low.value_or(found.low), render.color_high.value_or(found.high)};
    if (range.high <= range.low) range.high = range.low + std::max(1e-6, 1e-3 * std::abs(range.low));
    ranges_.push_back(range);
  }
}

FieldColors::FieldColors(const Film& film, const Simulation& simulation, const Recording& recording, ColorRanges ranges)
    : field_(film.render.color_by),
      map_(film.render.color_map.value_or(words_of(field_).map)),
      simulation_(simulation),
      recording_(recording),
      fps_(film.fps),
      measure_(strain_measure(film)),
      ranges_(std::move(ranges)) {}

/// The range over the frames from the first up to, but not including, the last.
ColorRange FieldColors::range_over(std::size_t first, std::size_t last) const {
  std::size_t count = 0;
  for (const SoftBody& body : simulation_.world.bodies) count += std::size_t(body.node_count());
  const std::size_t frames = last - first;
  const std::size_t stride = 1 + frames * count / kMaxValues;
  std::vector<double> values;
  values.reserve(frames * count / stride + frames);
  std::size_t next = 0;
  for (std::size_t frame = first; frame < last; ++frame) {
    for (std::size_t body = 0; body < simulation_.world.bodies.size(); ++body) {
      const Eigen::VectorXd of_body = field_values(field_, simulation_, recording_, frame, body, fps_, measure_);
      const std::size_t size = of_body.size();
      for (; next < size; next += stride) values.push_back(of_body[next]);
      next -= size;
    }
  }
  const auto [low, high] = extremes(values);
  switch (field_) {
    case Field::kVolume: {  // symmetric about the rest volume, the middle of the map
      const double reach = std::max(std::abs(high - 1), std::abs(1 - low));
      return {1 - reach, 1 + reach};
    }
    case Field::kStretch:
      return {std::min(low, 1.0), high};
    case Field::kFill:
      return {0, 1};
    case Field::kRegion:
      return {low, high};
    default:
      return {0, high};
  }
}

Eigen::VectorXd FieldColors::map_coordinates(std::size_t frame, std::size_t body) const {
  const Eigen::VectorXd values = field_values(field_, simulation_, recording_, frame, body, fps_, measure_);
  const ColorRange& range = range_in(ranges_, frame);
  return (values.array() - range.low) / (range.high - range.low);
}

Legend FieldColors::legend(std::size_t frame) const {
  const FieldWords words = words_of(field_);
  double largest = 0;
  for (const ColorRange& range : ranges_) largest = std::max({largest, std::abs(range.low), std::abs(range.high)});
  const Unit unit = *std::find_if(words.units.begin(), words.units.end(),
                                  [&](const Unit& candidate) { return largest >= candidate.from; });
  const bool has_name = unit.name[0] != '\0';
  const ColorRange& range = range_in(ranges_, frame);
  return {.title = has_name ? fmt::format("{}, {}", words.name, unit.name) : words.name,
          .map = map_,
          .low = range.low / unit.size,
          .high = range.high / unit.size,
          .swatches = {}};
}

}  // namespace sprung
