#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// Colours that are distinct with any kind of colour vision and dark enough for lines on white.
/// Source: Okabe and Ito, "Color Universal Design" (2008), its yellow left out.
namespace ink {
inline constexpr std::string_view kBlue = "#0072b2";
inline constexpr std::string_view kVermilion = "#d55e00";
inline constexpr std::string_view kGreen = "#009e73";
inline constexpr std::string_view kPurple = "#b8659a";
inline constexpr std::string_view kOrange = "#d99000";
inline constexpr std::string_view kSky = "#4aa3d8";
inline constexpr std::string_view kGrey = "#6e6e6e";
inline constexpr std::string_view kBlack = "#1b1b1b";
}  // namespace ink

enum class Scale { kLinear, kLog };
enum class Marker { kNone, kDot, kCircle, kSquare, kDiamond, kTriangle, kCross };

struct Axis {
  std::string label{};  // with the unit: "error of the tip deflection (%)"
  Scale scale = Scale::kLinear;
  std::vector<double> ticks{};                             // labelled values; empty: chosen from the data
  double low = std::numeric_limits<double>::quiet_NaN();   // the axis covers at least [low, high] and the data;
  double high = std::numeric_limits<double>::quiet_NaN();  // NaN: the data alone
};

struct Curve {
  std::string name{};                     // written beside the last point; empty: none
  std::vector<Eigen::Vector2d> points{};  // points that are not finite break the line
  std::string_view color = ink::kBlack;
  Marker marker = Marker::kNone;
  bool dashed = false;
  double width = 2;           // px; 0: markers only
  bool shows_values = false;  // writes y below every point, with two digits
};

struct SvgPlot {
  std::string title{};
  Axis x{};
  Axis y{};
  std::vector<Curve> curves{};        // the first is drawn on top
  std::optional<double> reference{};  // y of a dashed horizontal line
  bool has_legend = true;             // names of curves beside their ends
  double left = 14;                   // px, position in the figure, axes and labels included
  double top = 64;
  double width = 0;  // 0: to the figure's edge; height likewise
  double height = 0;
};

/// Plots on one white sheet under one heading.
struct Figure {
  std::string name{};  // of its file, without .svg
  std::string title{};
  std::string subtitle{};
  std::string caption{};  // not in the SVG: for the page that shows it
  double width = 820;     // px
  double height = 460;
  std::vector<SvgPlot> plots{};
};

/// The figure as the text of an SVG file. Names of curves that end close together are moved apart.
[[nodiscard]] std::string svg_text(const Figure& figure);

/// Text with the characters replaced that XML and HTML would misread.
[[nodiscard]] std::string escaped(std::string_view text);

/// Text with real minus signs instead of hyphens.
[[nodiscard]] std::string with_minus(std::string text);

/// The range of an axis: [low, high] with labelled ticks and further grid lines without labels.
struct AxisRange {
  Scale scale = Scale::kLinear;
  double low = 0;
  double high = 1;
  std::vector<double> ticks{};
  std::vector<double> minor{};

  /// 0 at low, 1 at high. On a log scale everything below low is at low.
  [[nodiscard]] double fraction(double value) const;
};

/// The range for data from `low` to `high`; it begins and ends at round numbers, unless the axis has ticks of its own.
/// Chosen ticks are 1, 2 or 5 times a power of ten; powers of ten only on a log axis of more than two decades.
[[nodiscard]] AxisRange axis_range(const Axis& axis, double low, double high);

/// The labels of the ticks: on a linear axis all with the same number of decimals, with a real minus sign.
[[nodiscard]] std::vector<std::string> tick_texts(const AxisRange& range);

}  // namespace sprung
