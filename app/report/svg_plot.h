#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/axis.h"

namespace sprung {

/// Colours that people with any kind of colour vision can tell apart, dark enough for lines on white.
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

enum class Marker { kNone, kDot, kCircle, kSquare, kDiamond, kTriangle, kCross };

struct Curve {
  std::string name{};                     // stands at the curve's right end; empty: none
  std::vector<Eigen::Vector2d> points{};  // by x; points that are not finite are left out and break the line
  std::string_view color = ink::kBlack;
  Marker marker = Marker::kNone;
  bool dashed = false;
  double width = 2;           // px; 0: markers only
  bool shows_values = false;  // y is written below every point, in two digits
};

/// A dashed horizontal line with a word over its left end.
struct GuideLine {
  double y = 0;
  std::string name;
};

struct SvgPlot {
  std::string title{};
  Axis x{};
  Axis y{};
  std::vector<Curve> curves{};  // the first is drawn on top
  std::optional<GuideLine> guide{};
  bool names_curves = true;  // else another panel of the figure does
};

/// A plot and the box of the figure it fills, px; axes and labels included.
struct Panel {
  SvgPlot plot;
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};

/// Plots on one white sheet under one heading.
struct Figure {
  std::string title{};
  std::string subtitle{};  // may be empty
  double width = 820;      // px
  double height = 460;
  std::vector<Panel> panels{};
};

/// Height that a figure's heading takes off the top, px.
inline constexpr double kHeadingHeight = 64;

/// A figure of one plot that fills it.
[[nodiscard]] Figure single_plot(std::string title, std::string subtitle, SvgPlot plot);

/// kFile is a picture of its own; kInline is part of an HTML page.
enum class SvgUse { kFile, kInline };

/// The figure as SVG text. Names of curves stand beside their right ends, moved apart where they would overlap.
[[nodiscard]] std::string svg_text(const Figure& figure, SvgUse use);

/// Text with what XML and HTML would misread replaced.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace sprung
