#include "app/validate/report.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/validate/plots.h"
#include "tests/support/report.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

using test::cantilever_checks;
using test::check;
using test::count_of;

Report sample_report() {
  const CasePicture picture{.picture = {Image(4, 2), "strain (%)", 0, 3}, .caption = "a picture"};
  Report report;
  report.sections = {{.title = "A bent beam",
                      .about = "It bends <under> its weight.",
                      .result = {.checks = {check("bending", "calibrated", 2, 1.2, 0.01),
                                            check("bending", "calibrated", 1, kNaN, 0.01)},
                                 .table = {.head = {"layout", "rank"}, .rows = {{"a < b", "-2"}}}},
                      .figures = {convergence_figure(cantilever_checks())}},
                     {.title = "A stretch",
                      .about = "Pulled.",
                      .result = {.checks = {check("stretch", "calibrated", 2, 1.001, 0.01),
                                            check("stretch", "fem", 2, 1.3), check("stretch", "m1", 2, 1, 0.01)}},
                      .picture = picture},
                     {.title = "Not run", .about = "Nothing to show."}};
  report.date = "today";
  return report;
}

TEST(HtmlReport, HasEverySectionAndLoadsNothing) {
  const std::string html = html_report(sample_report());
  for (const char* title : {"A bent beam", "A stretch"}) {
    EXPECT_EQ(count_of(html, "<h2>" + std::string(title)), 1U) << title;
  }
  EXPECT_EQ(html.find("Not run"), std::string::npos);
  EXPECT_EQ(html.find("<!--"), std::string::npos);
  EXPECT_EQ(count_of(html, "http"), count_of(html, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(count_of(html, "<svg"), 1U);
  EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,iVBORw0KGgo"), 1U);
  EXPECT_EQ(count_of(html, "src="), 1U);
  EXPECT_NE(html.find("bends &lt;under&gt; its"), std::string::npos);
  EXPECT_NE(html.find("<tr><td>a &lt; b</td><td class=\"n\">−2</td></tr>"), std::string::npos);
}

TEST(HtmlReport, CountsAndMarksResults) {
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

/// Two models on three grids are two rows, and all six measurements can still be unfolded.
TEST(HtmlReport, ShowsErrorsOverTheGridsInAMatrix) {
  std::vector<Check> checks;
  for (const char* model : {"calibrated", "fem"}) {
    for (const double across : {1.0, 2.0, 4.0}) {
      checks.push_back(check("bending", model, across, 1 + 0.1 / across, 0.06));
      checks.back().grid = std::to_string(int(across)) + "x1x1";
    }
  }
  checks.back().measured = kNaN;
  checks.back().tolerance = kNaN;
  checks.back().trouble = "it broke";
  const std::string html = html_report({.sections = {{.title = "Bending", .result = {.checks = checks}}}});
  EXPECT_EQ(count_of(html, "<table class=\"matrix\">"), 1U);
  EXPECT_EQ(count_of(html, "<th class=\"n\">4x1x1</th>"), 1U);
  EXPECT_EQ(count_of(html, "<td class=\"n bad\">10.00 %</td>"), 2U);
  EXPECT_EQ(count_of(html, "<td class=\"n good\">2.50 %</td>"), 1U);
  EXPECT_EQ(count_of(html, "<td class=\"n info\">no result</td>"), 1U);
  EXPECT_EQ(count_of(html, "<details>"), 1U);
  EXPECT_EQ(count_of(html, "<td>bending"), 0U);
  EXPECT_NE(html.find("theory; not measured: it broke"), std::string::npos);
}

/// The folder is created, figures are files of their own as well, and no partial files remain.
TEST(HtmlReport, IsWrittenWithItsFigures) {
  const TempFolder folder;
  const std::filesystem::path out = folder.path() / "a/report";
  make_report(out, {{.definition = {.name = "uniaxial", .title = "Stretch"}, .result = run_uniaxial({})}}, 1,
              Observer());
  const std::string html = text_of(out / "report.html");
  for (const char* name : {"stress_stretch.svg", "incompressibility.svg"}) {
    EXPECT_NE(html.find(text_of(out / name)), std::string::npos) << name;
  }
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
  }
}

}  // namespace
}  // namespace sprung
