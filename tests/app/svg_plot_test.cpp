#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/report/plots.h"
#include "tests/support/error_message.h"
#include "tests/support/report.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

using test::cantilever_checks;
using test::count_of;
using test::heights_of;
using test::kNone;
using test::xml_fault;

TEST(SvgPlot, IsWellFormed) {
  SvgPlot plot{.title = "a < b & c"};
  plot.x = {.label = "\"x\""};
  plot.y = {.label = "y", .scale = Scale::kLog};
  for (const Marker marker :
       {Marker::kNone, Marker::kCircle, Marker::kSquare, Marker::kDiamond, Marker::kTriangle, Marker::kCross}) {
    plot.curves.push_back({.name = "<curve>", .points = {{0, 1}, {1, kNone}, {2, 0}, {3, 30}}, .marker = marker});
  }
  plot.guide = GuideLine{5, "five & more"};
  for (const SvgUse use : {SvgUse::kFile, SvgUse::kInline}) {
    const std::string svg = svg_text(single_plot("t", "s", plot), use);
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
  EXPECT_EQ(xml_fault(svg_text(single_plot("empty", "", {}), SvgUse::kFile)), "");
}

TEST(SvgPlot, NamesOfCurvesThatEndTogetherDoNotOverlap) {
  SvgPlot plot;
  for (int i = 0; i < 8; ++i) plot.curves.push_back({.name = "name", .points = {{0, 0}, {1, 1 + 1e-3 * i}}});
  plot.curves.push_back({.name = "name", .points = {{0, 0}, {1, -3}}});
  const Figure figure = single_plot("t", "s", plot);
  std::vector<double> heights = heights_of(svg_text(figure, SvgUse::kFile), "name");
  ASSERT_EQ(heights.size(), 9U);
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GE(heights[i] - heights[i - 1], 14);
  EXPECT_GT(heights.front(), kHeadingHeight);
  EXPECT_LT(heights.back(), figure.height);
}

TEST(Plots, ShowEveryModelOfTheConvergence) {
  const std::string svg = svg_text(convergence_figure(cantilever_checks()), SvgUse::kFile);
  EXPECT_EQ(xml_fault(svg), "");
  for (const char* name : {"calibrated", "fem", "tensile", "m1 ", "m2-plain", "m1-plain"}) {
    EXPECT_EQ(heights_of(svg, name).size(), 1U) << name;
  }
  for (const char* poisson : {"ν = 0<", "ν = 0.3<", "ν = 0.49<"}) EXPECT_EQ(count_of(svg, poisson), 1U) << poisson;
}

TEST(Plots, LeaveOutWhatCouldNotBeMeasured) {
  std::vector<Check> checks = cantilever_checks();
  const std::size_t whole = count_of(svg_text(convergence_figure(checks), SvgUse::kFile), "<circle");
  checks.front().measured = kNone;  // a point of the calibrated curve, which has circles
  checks[1].measured = 1e6;
  const std::string svg = svg_text(convergence_figure(checks), SvgUse::kFile);
  EXPECT_EQ(count_of(svg, "<circle"), whole - 2);
  EXPECT_EQ(xml_fault(svg_text(convergence_figure({}), SvgUse::kFile)), "");
}

TEST(Plots, OfComputedDataAreWhole) {
  const std::string stretch = svg_text(stress_stretch_figure(), SvgUse::kFile);
  EXPECT_EQ(xml_fault(stretch), "");
  for (const char* name : {"calibrated", "tensile", "m1", "neo-Hookean", "St. Venant"}) {
    EXPECT_EQ(heights_of(stretch, name).size(), 1U) << name;
  }
  EXPECT_EQ(xml_fault(svg_text(incompressibility_figure(), SvgUse::kFile)), "");
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
  const std::string svg = svg_text(node_error_figure({errors, other}, 0.3), SvgUse::kFile);
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_EQ(heights_of(svg, "4×1×1").size(), 1U);
  EXPECT_EQ(count_of(svg, "r=\"1.5\""), 10U);
  EXPECT_EQ(xml_fault(svg_text(node_error_figure({}, 0.3), SvgUse::kFile)), "");
}

TEST(Plots, AreWrittenWholeOrNotAtAll) {
  const TempFolder folder;
  const Figure figure = single_plot("t", "s", {});
  write_svg(figure, folder.path() / "plot.svg");
  EXPECT_EQ(text_of(folder.path() / "plot.svg"), svg_text(figure, SvgUse::kFile));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "plot.svg.partial"));
  const std::string message = error_message([&] { write_svg(figure, folder.path() / "none" / "plot.svg"); });
  EXPECT_NE(message.find("cannot write '"), std::string::npos) << message;
}

}  // namespace
}  // namespace sprung
