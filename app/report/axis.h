#pragma once
#include <limits>
#include <string>
#include <vector>

namespace sprung {

enum class Scale { kLinear, kLog };

/// One axis of a plot, as asked for.
struct Axis {
  std::string label{};  // with the unit: "error of the tip deflection (%)"
  Scale scale = Scale::kLinear;
  std::vector<double> ticks{};                             // where the labels stand; empty: chosen
  double low = std::numeric_limits<double>::quiet_NaN();   // the axis shows at least this much; NaN: the data alone
  double high = std::numeric_limits<double>::quiet_NaN();  // decide
};

/// The part of an axis that is drawn: [low, high] covers all data and begins and ends at round numbers.
struct AxisRange {
  Scale scale = Scale::kLinear;
  double low = 0;
  double high = 1;
  std::vector<double> ticks;
  std::vector<double> minor;  // further grid lines, without labels

  /// 0 at low, 1 at high. On a log scale values at or below zero stand at low.
  [[nodiscard]] double fraction(double value) const;
};

/// The range for data from `low` to `high`. Ticks are 1, 2 or 5 times a power of ten, some five on a linear axis; on a
/// log axis that spans more than two decades they are the powers of ten.
[[nodiscard]] AxisRange axis_range(const Axis& axis, double low, double high);

/// The ticks as people read them: all with the same number of decimals on a linear axis, a real minus sign.
[[nodiscard]] std::vector<std::string> tick_texts(const AxisRange& range);

}  // namespace sprung
