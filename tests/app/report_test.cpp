#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/report/axis.h"
#include "app/report/experiment_picture.h"
#include "app/report/html_report.h"
#include "app/report/locking.h"
#include "app/report/plots.h"
#include "app/report/png_base64.h"
#include "app/report/uniaxial.h"
#include "tests/support/bodies.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What is wrong with a piece of XML: tags that do not match, attributes without quotes, a stray < or &. Empty:
/// nothing.
std::string xml_fault(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < xml.size(); ++at) {
    if (xml[at] == '&') {
      const std::size_t end = xml.find(';', at);
      if (end == std::string::npos || end - at > 6) return "stray & at " + std::to_string(at);
    }
    if (xml[at] != '<') continue;
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "open < at " + std::to_string(at);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "< in a tag: " + tag;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "odd quotes: " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.front() == '/') {
      if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Check check(const std::string& experiment, const std::string& model, double across, double measured,
            double tolerance = kNone, double poisson = 0.3) {
  Check check;
  check.experiment = experiment;
  check.quantity = "tip <deflection> & \"more\"";
  check.model = model;
  check.poisson = poisson;
  check.grid = "8x2x2";
  check.bricks_across = across;
  check.measured = measured;
  check.expected = 1;
  check.unit = "mm";
  check.source = "theory";
  check.tolerance = tolerance;
  return check;
}

std::vector<Check> cantilever_checks() {
  std::vector<Check> checks;
  for (const char* model : {"calibrated", "fem", "tensile", "m1", "m2-plain", "m1-plain"}) {
    for (const double poisson : {0.0, 0.3, 0.49}) {
      for (const double across : {1.0, 2.0, 4.0, 8.0}) {
        checks.push_back(check("cantilever", model, across, 1 - 0.3 / (across * across), kNone, poisson));
      }
    }
  }
  return checks;
}

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

TEST(Axis, WritesTicksAsPeopleDo) {
  EXPECT_EQ(tick_texts(axis_range({.label = "m"}, -1, 1)),
            (std::vector<std::string>{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 0.1, 100)),
            (std::vector<std::string>{"0.1", "1", "10", "100"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 1e-6, 2e-5)).front(), "10⁻⁶");
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .ticks = {0, 0.25, 0.5}}, 0, 0.5)),
            (std::vector<std::string>{"0.00", "0.25", "0.50"}));
}

TEST(SvgPlot, IsWellFormed) {
  Plot plot{.title = "a < b & c"};
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

/// The heights of texts that hold the word, px.
std::vector<double> heights_of(const std::string& svg, const std::string& word) {
  std::vector<double> heights;
  for (std::size_t at = svg.find(">" + word); at != std::string::npos; at = svg.find(">" + word, at + 1)) {
    const std::size_t y = svg.find(" y=\"", svg.rfind("<text", at));
    heights.push_back(std::stod(svg.substr(y + 4)));
  }
  return heights;
}

TEST(SvgPlot, NamesOfCurvesThatEndTogetherDoNotOverlap) {
  Plot plot;
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
  for (const char* name : {"calibrated", "tensile", "neo-Hookean", "St. Venant"}) {
    EXPECT_EQ(heights_of(stretch, name).size(), 1U) << name;
  }
  EXPECT_EQ(xml_fault(svg_text(incompressibility_figure(), SvgUse::kFile)), "");
  const CentrelineErrors errors{"fem", 0.3, "4x1x1", {0, 0.5, 1}, {0, -0.1, -0.3}};
  const std::string centreline = svg_text(centreline_figure({errors}, "% of the tip's"), SvgUse::kFile);
  EXPECT_EQ(xml_fault(centreline), "");
  EXPECT_EQ(heights_of(centreline, "4×1×1").size(), 1U);
}

TEST(Plots, AreWrittenWholeOrNotAtAll) {
  const TempFolder folder;
  const Figure figure = single_plot("t", "s", {});
  write_svg(figure, folder.path() / "plot.svg");
  EXPECT_EQ(text_of(folder.path() / "plot.svg"), svg_text(figure, SvgUse::kFile));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "plot.svg.partial"));
  const std::string message = error_message([&] { write_svg(figure, folder.path() / "none" / "plot.svg"); });
  EXPECT_NE(message.find("plot.svg: cannot write"), std::string::npos) << message;
}

/// Every law answers small strains with E and nu.
TEST(Uniaxial, SlopeAtRestIsYoungsModulus) {
  constexpr double kStep = 1e-4;
  for (const double poisson : {-0.2, 0.0, 0.25, 0.3, 0.45, 0.49}) {
    const Material material = test::test_material(poisson, 2e4);
    const auto expect_elastic = [&](const auto& law) {
      const UniaxialResponse more = law(1 + kStep);
      const UniaxialResponse less = law(1 - kStep);
      EXPECT_NEAR((more.stress - less.stress) / (2 * kStep) / material.young, 1, 1e-6) << poisson;
      EXPECT_NEAR((more.sideways - less.sideways) / (2 * kStep), -poisson, 1e-6) << poisson;
    };
    for (const Model model : test::kCorrectedModels) {
      expect_elastic([&](double stretch) { return brick_uniaxial(model, material, stretch); });
    }
    expect_elastic([&](double stretch) { return st_venant_kirchhoff_uniaxial(material, stretch); });
    expect_elastic([&](double stretch) { return neo_hookean_uniaxial(material, stretch); });
  }
}

/// At nu = 0 nothing moves sideways in St. Venant-Kirchhoff: stress = E s (s^2 - 1) / 2.
TEST(Uniaxial, AgreesWithClosedForms) {
  const UniaxialResponse venant = st_venant_kirchhoff_uniaxial(test::test_material(0, 1), 2);
  EXPECT_DOUBLE_EQ(venant.sideways, 1);
  EXPECT_DOUBLE_EQ(venant.stress, 3);
  // Nearly incompressible: t = 1/sqrt(s), stress = G (s - 1/s^2).
  const Material rubber = test::test_material(0.499999, 3);
  const UniaxialResponse neo = neo_hookean_uniaxial(rubber, 2);
  EXPECT_NEAR(neo.sideways, std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(neo.stress, rubber.shear_modulus() * (2 - 0.25), 1e-4);
}

TEST(Uniaxial, FindsTheSidewaysStretchOverTheWholePlot) {
  for (const Model model : test::kCorrectedModels) {
    for (int i = 0; i <= 30; ++i) {
      const double stretch = 0.5 + 0.05 * i;
      EXPECT_TRUE(std::isfinite(brick_uniaxial(model, test::test_material(0.3), stretch).stress)) << stretch;
    }
  }
}

TEST(Locking, StopsTheHexahedronAndNotTheBrick) {
  const auto references = reference_deflections();
  const DeflectionAt& near_half = references.back();
  ASSERT_DOUBLE_EQ(near_half.poisson, 0.49);
  EXPECT_NEAR(cantilever_deflection(Model::kCalibrated, 0.49, 4) / near_half.deflection, 1, 0.04);
  EXPECT_LT(cantilever_deflection(Model::kFem, 0.49, 4) / near_half.deflection, 0.75);
}

TEST(Base64, FollowsTheStandardsExamples) {
  const auto encoded = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::byte>(3, std::byte{0xFF})), "////");
}

Report sample_report() {
  Report report;
  report.checks = {check("stretch", "calibrated", 2, 1.001, 0.01), check("stretch", "fem", 2, 1.3),
                   check("bending", "calibrated", 2, 1.2, 0.01), check("bending", "calibrated", 1, kNone, 0.01),
                   check("surprise", "m1", 2, 1, 0.01)};
  report.experiments = {{"bending", "A bent beam", "It bends <under> its weight."},
                        {"stretch", "A stretch", "Pulled."},
                        {"absent", "Not run", "Nothing to show."}};
  report.plots = {{"bending", "a plot", convergence_figure(cantilever_checks())}};
  report.pictures = {{"stretch", "a picture", Image(4, 2), {"strain (%)", 0, 3}}};
  report.made = "today";
  return report;
}

TEST(HtmlReport, HoldsEveryExperimentAndNothingFromOutside) {
  const std::string html = html_report(sample_report());
  for (const char* title : {"A bent beam", "A stretch", "surprise"}) {
    EXPECT_EQ(count_of(html, "<h2>" + std::string(title)), 1U) << title;
  }
  EXPECT_LT(html.find("<h2>A bent beam"), html.find("<h2>A stretch"));
  EXPECT_EQ(html.find("Not run"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(count_of(html, "<svg"), 1U);
  EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,iVBORw0KGgo"), count_of(html, "src="));
  EXPECT_EQ(count_of(html, "<img"), 1U);
  EXPECT_NE(html.find("bends &lt;under&gt; its"), std::string::npos);
}

TEST(HtmlReport, CountsAndMarksVerdicts) {
  const std::string html = html_report(sample_report());
  EXPECT_NE(html.find("<b class=\"good\">2</b><span>passed"), std::string::npos);
  EXPECT_NE(html.find("<b class=\"bad\">2</b><span>failed"), std::string::npos);
  EXPECT_NE(html.find("2 of 2 failed"), std::string::npos);
  EXPECT_EQ(count_of(html, "✗ fail</td>"), 2U);
  EXPECT_EQ(count_of(html, "✓ pass</td>"), 2U);
  EXPECT_NE(html.find(">0.10 %<"), std::string::npos);
  EXPECT_NE(html.find(">20.00 %<"), std::string::npos);
  EXPECT_EQ(html.find("nan"), std::string::npos);
}

TEST(HtmlReport, IsWrittenWhole) {
  const TempFolder folder;
  write_html_report(sample_report(), folder.path() / "report.html");
  EXPECT_EQ(text_of(folder.path() / "report.html"), html_report(sample_report()));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report.html.partial"));
}

TEST(ExperimentPicture, ShowsTheBodyOnWhite) {
  Body body = make_body(make_box_grid({4, 2, 2}, 0.05), Model::kCalibrated, test::test_material(0.3));
  for (int i = 0; i < body.node_count(); ++i) body.positions(i, 0) *= 1.1;
  const ExperimentPicture picture = draw_experiment(body, {.width = 160, .height = 100});
  EXPECT_EQ(picture.colors.label, "displacement (mm)");
  EXPECT_NEAR(picture.colors.high, 20, 1e-9);
  const std::vector<std::uint8_t>& pixels = picture.image.pixels;
  EXPECT_TRUE(std::all_of(pixels.begin(), pixels.begin() + 3L * 160, [](int level) { return level > 250; }));
  const std::size_t middle = std::size_t{3} * (50U * 160U + 80U);
  EXPECT_LT(std::min({pixels[middle], pixels[middle + 1], pixels[middle + 2]}), 200);
  const ExperimentPicture strain = draw_experiment(body, {.color_by = ColorBy::kStrain, .width = 160, .height = 100});
  EXPECT_NEAR(strain.colors.high, 100 * 0.5 * (1.1 * 1.1 - 1), 1e-9);
}

}  // namespace
}  // namespace sprung
