#include "core/world/keyframes.h"

#include <algorithm>
#include <numbers>

#include "core/types.h"

namespace sprung {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// The slope between two intervals: the weighted harmonic mean of theirs, or zero at reversals.
double inner_slope(double before, double after, double time_before, double time_after) {
  if (before * after <= 0) return 0;
  const double weight_before = time_before + 2 * time_after;
  const double weight_after = 2 * time_before + time_after;
  return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

}  // namespace

Movement::Values Movement::values_of(const Keyframe& keyframe) {
  Values values;
  values << keyframe.translate, kRadians * keyframe.rotate, keyframe.scale;
  return values;
}

Movement::Movement(std::vector<Keyframe> keyframes, Interpolation interpolation)
    : interpolation_(interpolation), keyframes_(std::move(keyframes)) {
  if (keyframes_.empty() || keyframes_.front().time > 0) keyframes_.insert(keyframes_.begin(), Keyframe{});
  for (const Keyframe& keyframe : keyframes_) values_.push_back(values_of(keyframe));
  if (interpolation_ == Interpolation::kSmooth) find_slopes();
}

void Movement::find_slopes() {
  slopes_.assign(values_.size(), Values::Zero());
  for (std::size_t i = 1; i + 1 < values_.size(); ++i) {
    const double time_before = keyframes_[i].time - keyframes_[i - 1].time;
    const double time_after = keyframes_[i + 1].time - keyframes_[i].time;
    for (int k = 0; k < slopes_[i].size(); ++k) {
      slopes_[i][k] = inner_slope((values_[i][k] - values_[i - 1][k]) / time_before,
                                  (values_[i + 1][k] - values_[i][k]) / time_after, time_before, time_after);
    }
  }
}

Movement::Point Movement::at(double time) const {
  const auto is_later = [](double moment, const Keyframe& keyframe) { return moment < keyframe.time; };
  const auto next =
      std::size_t(std::upper_bound(keyframes_.begin(), keyframes_.end(), time, is_later) - keyframes_.begin());
  if (next == 0) return {values_.empty() ? values_of({}) : values_.front(), Values::Zero()};
  const std::size_t last = next - 1;
  if (next == keyframes_.size() || interpolation_ == Interpolation::kHeld) return {values_[last], Values::Zero()};
  const double span = keyframes_[next].time - keyframes_[last].time;
  const double share = (time - keyframes_[last].time) / span;
  const Values change = values_[next] - values_[last];
  if (interpolation_ == Interpolation::kLinear) return {values_[last] + share * change, change / span};
  // The cubic Hermite interpolant.
  const Values bend = span * (slopes_[last] + slopes_[next]) - 2 * change;
  const Values start = span * slopes_[last];
  const Values sag = change - start - bend;
  return {values_[last] + share * (start + share * (sag + share * bend)),
          (start + share * (2 * sag + 3 * share * bend)) / span};
}

Placement Movement::placement(double time) const {
  const Values values = at(time).values;
  return {.shift = values.head<3>(), .rotation = rotation_matrix(values.segment<3>(3) / kRadians), .scale = values[6]};
}

PlacementRate Movement::rate(double time) const {
  const auto [values, rates] = at(time);
  const Eigen::AngleAxisd about_y(values[4], Vec3::UnitY());
  const Eigen::AngleAxisd about_z(values[5], Vec3::UnitZ());
  const Vec3 spin =
      rates[5] * Vec3::UnitZ() + about_z * Vec3(rates[4] * Vec3::UnitY() + about_y * Vec3(rates[3] * Vec3::UnitX()));
  return {.shift = rates.head<3>(), .spin = spin, .growth = rates[6] / values[6]};
}

PlacementRate Movement::small_placement(double time) const {
  const Values values = at(time).values;
  return {.shift = values.head<3>(), .spin = values.segment<3>(3), .growth = values[6] - 1};
}

bool Movement::is_still() const {
  return std::all_of(values_.begin(), values_.end(), [](const Values& values) { return values == values_of({}); });
}

}  // namespace sprung
