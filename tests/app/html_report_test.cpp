#include "app/report/html_report.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/report/plots.h"
#include "app/report/png_base64.h"
#include "tests/support/report.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

using test::cantilever_checks;
using test::check;
using test::count_of;
using test::kNone;

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

/// Two models on three grids are two rows, and all six measurements stay to be unfolded.
TEST(HtmlReport, ShowsErrorsOverTheGridsInAMatrix) {
  Report report;
  for (const char* model : {"calibrated", "fem"}) {
    for (const double across : {1.0, 2.0, 4.0}) {
      report.checks.push_back(check("bending", model, across, 1 + 0.1 / across, 0.06));
      report.checks.back().grid = std::to_string(int(across)) + "x1x1";
    }
  }
  report.checks.back().measured = kNone;
  report.checks.back().tolerance = kNone;
  report.checks.back().trouble = "it broke";
  const std::string html = html_report(report);
  EXPECT_EQ(count_of(html, "<table class=\"matrix\">"), 1U);
  EXPECT_EQ(count_of(html, "<th class=\"n\">4x1x1</th>"), 1U);
  EXPECT_EQ(count_of(html, "<td class=\"n bad\">10.00 %</td>"), 2U);
  EXPECT_EQ(count_of(html, "<td class=\"n good\">2.50 %</td>"), 1U);
  EXPECT_EQ(count_of(html, "<td class=\"n info\">no result</td>"), 1U);
  EXPECT_EQ(count_of(html, "<details>"), 1U);
  EXPECT_EQ(count_of(html, "<td>bending"), 0U);
  EXPECT_NE(html.find("theory; not measured: it broke"), std::string::npos);
}

TEST(HtmlReport, ShowsTables) {
  Report report = sample_report();
  report.tables = {{"bending", {.head = {"layout", "rank"}, .rows = {{"a < b", "-2"}}}}};
  EXPECT_NE(html_report(report).find("<tr><td>a &lt; b</td><td class=\"n\">−2</td></tr>"), std::string::npos);
}

TEST(HtmlReport, IsWrittenWhole) {
  const TempFolder folder;
  write_html_report(sample_report(), folder.path() / "report.html");
  EXPECT_EQ(text_of(folder.path() / "report.html"), html_report(sample_report()));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report.html.partial"));
}

}  // namespace
}  // namespace sprung
