#include "app/validate/svg_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/validate/plots.h"
#include "tests/support/report.h"

namespace sprung {
namespace {

using test::cantilever_checks;
using test::count_of;
using test::heights_of;
using test::xml_fault;

TEST(Axis, CoversItsData) {
  constexpr std::array<std::array<double, 2>, 8> kSpans{
      {{0, 1}, {-3.2, 17}, {0.0012, 0.0013}, {5, 5}, {0, 0}, {-1e6, 3e6}, {0.9, 1.1}, {1e-9, 2e-7}}};
  for (const auto& [low, high] : kSpans) {
    const AxisRange range = axis_range({.label = "m"}, low, high);
    ASSERT_GE(range.ticks.size(), 3U) << low << " to " << high;
    EXPECT_LE(range.ticks.size(), 11U) << low << " to " << high;
    EXPECT_LE(range.ticks.front(), low + 1e-9 * std::abs(low));
    EXPECT_GE(range.ticks.back(), high - 1e-9 * std::abs(high));
    EXPECT_TRUE(std::is_sorted(range.ticks.begin(), range.ticks.end()));
  }
}

TEST(Axis, CoversItsDataOnALogScale) {
  constexpr std::array<std::array<double, 2>, 6> kSpans{
      {{1, 8}, {0.063, 57}, {3, 3}, {1e-14, 0.2}, {0.5, 2}, {10, 1000}}};
  for (const auto& [low, high] : kSpans) {
    const AxisRange range = axis_range({.label = "m", .scale = Scale::kLog}, low, high);
    EXPECT_LE(range.low, low * (1 + 1e-9));
    EXPECT_GE(range.high, high * (1 - 1e-9));
    EXPECT_GE(range.ticks.size(), 2U) << low << " to " << high;
    for (const double tick : range.ticks) {
      EXPECT_GE(range.fraction(tick), -1e-9);
      EXPECT_LE(range.fraction(tick), 1 + 1e-9);
    }
  }
  const AxisRange decades = axis_range({.label = "m", .scale = Scale::kLog}, 1, 1000);
  EXPECT_NEAR(decades.fraction(10), 1.0 / 3, 1e-12);
}

TEST(Axis, WritesTicks) {
  EXPECT_EQ(tick_texts(axis_range({.label = "m"}, -1, 1)),
            (std::vector<std::string>{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 0.1, 100)),
            (std::vector<std::string>{"0.1", "1", "10", "100"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 1e-6, 2e-5)).front(), "1e−06");
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .ticks = {0, 0.25, 0.5}}, 0, 0.5)),
            (std::vector<std::string>{"0.00", "0.25", "0.50"}));
}

TEST(SvgPlot, IsWellFormed) {
  SvgPlot plot{.title = "a < b & c"};
  plot.x = {.label = "\"x\""};
  plot.y = {.label = "y", .scale = Scale::kLog};
  for (const Marker marker : {Marker::kNone, Marker::kDot, Marker::kCircle, Marker::kSquare, Marker::kDiamond,
                              Marker::kTriangle, Marker::kCross}) {
    plot.curves.push_back({.name = "<curve>", .points = {{0, 1}, {1, kNaN}, {2, 0}, {3, 30}}, .marker = marker});
  }
  plot.reference = 5;
  const std::string svg = svg_text({.title = "t", .subtitle = "s", .plots = {plot}});
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(xml_fault(svg_text({.title = "empty", .plots = {{}}})), "");
}

TEST(SvgPlot, NamesOfCurvesThatEndTogetherDoNotOverlap) {
  SvgPlot plot;
  for (int i = 0; i < 8; ++i) plot.curves.push_back({.name = "name", .points = {{0, 0}, {1, 1 + 1e-3 * i}}});
  plot.curves.push_back({.name = "name", .points = {{0, 0}, {1, -3}}});
  const Figure figure{.title = "t", .subtitle = "s", .plots = {plot}};
  std::vector<double> heights = heights_of(svg_text(figure), "name");
  ASSERT_EQ(heights.size(), 9U);
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GE(heights[i] - heights[i - 1], 14);
  EXPECT_GT(heights.front(), plot.top);
  EXPECT_LT(heights.back(), figure.height);
}

TEST(Plots, ShowEveryModelOfTheConvergence) {
  const std::string svg = svg_text(convergence_figure(cantilever_checks()));
  EXPECT_EQ(xml_fault(svg), "");
  for (const char* name : {"calibrated", "fem", "tensile", "m1 ", "m2-plain", "m1-plain"}) {
    EXPECT_EQ(heights_of(svg, name).size(), 1U) << name;
  }
  for (const char* poisson : {"ν = 0<", "ν = 0.3<", "ν = 0.49<"}) EXPECT_EQ(count_of(svg, poisson), 1U) << poisson;
}

TEST(Plots, LeaveOutWhatCouldNotBeMeasured) {
  std::vector<Check> checks = cantilever_checks();
  const auto points = [&] {
    std::size_t count = 0;
    for (const SvgPlot& plot : convergence_figure(checks).plots) count += plot.curves.front().points.size();
    return count;
  };
  EXPECT_EQ(points(), 12U);
  checks.front().measured = kNaN;  // of the calibrated curve
  checks[1].measured = 1e6;
  EXPECT_EQ(points(), 10U);
  EXPECT_EQ(xml_fault(svg_text(convergence_figure({}))), "");
}

TEST(Plots, OfComputedDataAreWhole) {
  const std::string stretch = svg_text(stress_stretch_figure());
  EXPECT_EQ(xml_fault(stretch), "");
  for (const char* name : {"calibrated", "tensile", "m1", "neo-Hookean", "St. Venant"}) {
    EXPECT_EQ(heights_of(stretch, name).size(), 1U) << name;
  }
  EXPECT_EQ(xml_fault(svg_text(incompressibility_figure())), "");
}

TEST(Plots, ShowEveryNodeOfTheChosenRatio) {
  NodeErrors errors{.model = "fem", .poisson = 0.3, .grid = "4x1x1", .nodes = {}, .largest = 2};
  for (int i = 0; i <= 4; ++i) {
    for (const double side : {-0.01, 0.01}) {
      errors.nodes.push_back({.along = i / 4.0, .known = Vec3(0, -0.5 * i, 0), .error = Vec3(0, 0.1 * i + side, 0)});
    }
  }
  NodeErrors other = errors;
  other.poisson = 0;
  const std::string svg = svg_text(node_error_figure({errors, other}));
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_EQ(heights_of(svg, "4×1×1").size(), 1U);
  EXPECT_EQ(count_of(svg, "h0"), 10U);  // dots
  EXPECT_EQ(xml_fault(svg_text(node_error_figure({}))), "");
}

}  // namespace
}  // namespace sprung
