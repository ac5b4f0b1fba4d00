#include "app/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/report/check_tables.h"
#include "app/report/png_base64.h"
#include "app/report/report_style.h"
#include "core/files.h"
#include "render/image/color_map.h"

namespace sprung {

namespace {

using Checks = std::vector<const Check*>;

struct Tally {
  int passed = 0;
  int failed = 0;
  int informative = 0;
};

Tally tally(const Checks& checks) {
  Tally tally;
  for (const Check* check : checks) {
    if (!check->is_gate()) {
      ++tally.informative;
    } else {
      ++(check->passed() ? tally.passed : tally.failed);
    }
  }
  return tally;
}

/// "12 passed", "1 of 13 failed", "3 measured".
std::string verdict(const Tally& tally) {
  const int gates = tally.passed + tally.failed;
  if (tally.failed > 0) return fmt::format(R"(<span class="bad">✗ {} of {} failed</span>)", tally.failed, gates);
  if (gates > 0) return fmt::format(R"(<span class="good">✓ {} passed</span>)", gates);
  return fmt::format("{} measured", tally.informative);
}

std::string color_bar(const ColorBar& colors) {
  if (colors.label.empty()) return "";
  std::string stops;
  constexpr int kStops = 8;
  for (int i = 0; i <= kStops; ++i) {
    const Eigen::Vector3f color = 255 * map_color(ColorMap::kViridis, double(i) / kStops);
    stops += fmt::format(",rgb({:.0f} {:.0f} {:.0f})", color.x(), color.y(), color.z());
  }
  return fmt::format(
      "<div class=\"bar\">{}<i style=\"background:linear-gradient(90deg{})\"></i>{}<span>{}</span></div>\n",
      html_number(colors.low), stops, fmt::format("{:.3g}", colors.high), escaped(colors.label));
}

std::string plots_and_pictures(const Report& report, const std::string& experiment) {
  std::string out;
  for (const ReportPlot& plot : report.plots) {
    if (plot.experiment != experiment) continue;
    out += fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg_text(plot.figure, SvgUse::kInline),
                       escaped(plot.caption));
  }
  std::string pictures;
  for (const ReportPicture& picture : report.pictures) {
    if (picture.experiment != experiment) continue;
    pictures += fmt::format(
        "<figure><img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">\n"
        "{}<figcaption>{}</figcaption></figure>\n",
        escaped(picture.caption), picture.image.width, picture.image.height, png_base64(picture.image),
        color_bar(picture.colors), escaped(picture.caption));
  }
  return pictures.empty() ? out : out + "<div class=\"pictures\">\n" + pictures + "</div>\n";
}

std::string tables_of(const Report& report, const std::string& experiment) {
  std::string out;
  for (const ReportTable& table : report.tables) {
    if (table.experiment == experiment) out += html_table(table.table);
  }
  return out;
}

/// The experiments of the page: the described ones that have something to show, then the others.
std::vector<ReportExperiment> experiments_of(const Report& report) {
  std::vector<ReportExperiment> experiments;
  const auto shown = [&](const std::string& name) {
    return std::any_of(experiments.begin(), experiments.end(), [&](const auto& one) { return one.name == name; });
  };
  for (const ReportExperiment& described : report.experiments) {
    const auto is_it = [&](const auto& one) { return one.experiment == described.name; };
    if (std::any_of(report.checks.begin(), report.checks.end(), is_it) ||
        std::any_of(report.plots.begin(), report.plots.end(), is_it) ||
        std::any_of(report.pictures.begin(), report.pictures.end(), is_it) ||
        std::any_of(report.tables.begin(), report.tables.end(), is_it)) {
      experiments.push_back(described);
    }
  }
  for (const Check& check : report.checks) {
    if (!shown(check.experiment)) experiments.push_back({check.experiment, check.experiment, ""});
  }
  return experiments;
}

Checks checks_of(const Report& report, const std::string& experiment) {
  Checks checks;
  for (const Check& check : report.checks) {
    if (check.experiment == experiment) checks.push_back(&check);
  }
  return checks;
}

std::string header(const Report& report) {
  Checks all;
  for (const Check& check : report.checks) all.push_back(&check);
  const Tally sum = tally(all);
  return fmt::format(
      "<header>\n<h1>sprung validate</h1>\n<p class=\"made\">version {}{}{} · {:.1f} s</p>\n<div class=\"tally\">"
      "<div><b class=\"good\">{}</b><span>passed</span></div><div><b{}>{}</b><span>failed</span></div>"
      "<div><b>{}</b><span>measured, without a tolerance</span></div></div>\n</header>\n",
      SPRUNG_VERSION, report.made.empty() ? "" : " · ", escaped(report.made), report.seconds, sum.passed,
      sum.failed > 0 ? " class=\"bad\"" : "", sum.failed, sum.informative);
}

}  // namespace

std::string html_report(const Report& report) {
  const std::vector<ReportExperiment> experiments = experiments_of(report);
  std::string contents = "<nav>\n";
  std::string sections;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const ReportExperiment& one = experiments[i];
    const Checks checks = checks_of(report, one.name);
    const std::string state = checks.empty() ? "" : verdict(tally(checks));
    contents += fmt::format("<a href=\"#e{}\"><span>{}</span>{}</a>\n", i, escaped(one.title), state);
    sections += fmt::format("<section id=\"e{}\">\n<h2>{}</h2>\n", i, escaped(one.title));
    if (!one.what.empty()) sections += fmt::format("<p class=\"what\">{}</p>\n", escaped(one.what));
    sections +=
        tables_of(report, one.name) + html_checks(checks) + plots_and_pictures(report, one.name) + "</section>\n";
  }
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
             "content=\"width=device-width, initial-scale=1\">\n<title>sprung validate</title>\n<style>{}</style>\n"
             "</head>\n<body>\n",
             kReportStyle) +
         header(report) + contents + "</nav>\n" + plots_and_pictures(report, "") + sections + "</body>\n</html>\n";
}

void write_html_report(const Report& report, const std::filesystem::path& file) {
  write_file(file, html_report(report));
}

}  // namespace sprung
