#include "app/report/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sprung {

namespace {

constexpr double kWantedSteps = 5;
constexpr double kWideDecades = 2;  // beyond it only powers of ten are labelled
constexpr double kSlack = 1e-9;     // of a step or a value, against rounding
constexpr double kPadding = 0.05;   // of a range whose ticks are given, so that markers do not sit on the frame

/// The 1-2-5 number next to `raw`.
double round_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

AxisRange linear_range(double low, double high) {
  if (high - low <= kSlack * std::max(std::abs(low), std::abs(high))) {
    const double room = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= room;
    high += room;
  }
  const double step = round_step((high - low) / kWantedSteps);
  const double first = std::floor(low / step + kSlack);
  const double last = std::ceil(high / step - kSlack);
  AxisRange range{Scale::kLinear, first * step, last * step, {}, {}};
  for (double i = first; i <= last; ++i) range.ticks.push_back(i * step);
  return range;
}

/// 1, 2 and 5 times powers of ten that enclose [low, high].
std::vector<double> one_two_five(double low, double high) {
  std::vector<double> values;
  const double first = std::floor(std::log10(low));
  for (double decade = first; values.empty() || values.back() < high * (1 - kSlack); ++decade) {
    for (const double lead : {1.0, 2.0, 5.0}) {
      const double value = lead * std::pow(10.0, decade);
      if (value <= low * (1 + kSlack)) values.clear();
      values.push_back(value);
      if (value >= high * (1 - kSlack)) break;
    }
  }
  return values;
}

std::vector<double> powers_of_ten(double low, double high) {
  std::vector<double> values;
  const double last = std::ceil(std::log10(high) - kSlack);
  for (double d = std::floor(std::log10(low) + kSlack); d <= last; ++d) values.push_back(std::pow(10.0, d));
  return values;
}

AxisRange log_range(double low, double high) {
  std::vector<double> ends = one_two_five(low, high);
  if (ends.size() < 2) ends = one_two_five(low, 1.5 * low);
  AxisRange range{Scale::kLog, ends.front(), ends.back(), {}, {}};
  const bool wide = high > low * std::pow(10.0, kWideDecades);
  for (const double tick : wide ? powers_of_ten(range.low, range.high) : ends) {
    if (tick >= range.low * (1 - kSlack) && tick <= range.high * (1 + kSlack)) range.ticks.push_back(tick);
  }
  for (const double decade : powers_of_ten(range.low, range.high)) {
    for (int lead = 2; lead <= 9; ++lead) {
      const double value = lead * decade;
      if (value > range.low && value < range.high) range.minor.push_back(value);
    }
  }
  return range;
}

AxisRange given_range(const Axis& axis, double low, double high) {
  low = std::min(low, *std::min_element(axis.ticks.begin(), axis.ticks.end()));
  high = std::max(high, *std::max_element(axis.ticks.begin(), axis.ticks.end()));
  if (axis.scale == Scale::kLinear) {
    const double room = kPadding * (high - low);
    return {axis.scale, low - room, high + room, axis.ticks, {}};
  }
  const double room = std::pow(high / low, kPadding);
  return {axis.scale, low / room, high * room, axis.ticks, {}};
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

std::string raised(int number) {
  constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char digit : std::to_string(number)) text += digit == '-' ? "⁻" : kDigits[digit - '0'];
  return text;
}

/// A value of a log axis: short as it is, else as 2·10⁻⁵.
std::string free_text(double value) {
  if (value == 0 || (std::abs(value) < 1e5 && std::abs(value) > 9e-4)) return with_minus(fmt::format("{:.6g}", value));
  const int power = int(std::floor(std::log10(std::abs(value)) + kSlack));
  const double lead = value / std::pow(10.0, power);
  const std::string tens = "10" + raised(power);
  return std::abs(lead - 1) < 1e-6 ? tens : with_minus(fmt::format("{:.3g}", lead)) + "·" + tens;
}

}  // namespace

double AxisRange::fraction(double value) const {
  if (scale == Scale::kLinear) return (value - low) / (high - low);
  return std::log(std::max(value, low) / low) / std::log(high / low);
}

AxisRange axis_range(const Axis& axis, double low, double high) {
  if (std::isfinite(axis.low)) low = std::min(low, axis.low);
  if (std::isfinite(axis.high)) high = std::max(high, axis.high);
  if (!axis.ticks.empty()) return given_range(axis, low, high);
  return axis.scale == Scale::kLinear ? linear_range(low, high) : log_range(low, high);
}

std::vector<std::string> tick_texts(const AxisRange& range) {
  double step = range.high - range.low;
  double largest = 0;
  for (std::size_t i = 0; i < range.ticks.size(); ++i) {
    if (i > 0) step = std::min(step, range.ticks[i] - range.ticks[i - 1]);
    largest = std::max(largest, std::abs(range.ticks[i]));
  }
  const bool free = range.scale == Scale::kLog || largest >= 1e5 || step < 1e-4;
  // 2.5 needs a decimal more than its order of magnitude.
  int decimals = std::max(0, int(-std::floor(std::log10(step) + kSlack)));
  if (std::abs(step * std::pow(10.0, decimals) - std::round(step * std::pow(10.0, decimals))) > 1e-6) ++decimals;
  std::vector<std::string> texts;
  for (const double tick : range.ticks) {
    const double value = std::abs(tick) < kSlack * step ? 0 : tick;
    texts.push_back(free ? free_text(value) : with_minus(fmt::format("{:.{}f}", value, decimals)));
  }
  return texts;
}

}  // namespace sprung
