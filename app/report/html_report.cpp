#include "app/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/png_base64.h"
#include "app/report/report_style.h"
#include "app/report/whole_file.h"

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

std::string number(double value) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.5g}", value);
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text;
}

/// A share in per cent; tiny ones with their power of ten, since 0.00 would hide them.
std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  const double value = 100 * share;
  const bool tiny = value != 0 && std::abs(value) < 0.005;
  std::string text = tiny ? fmt::format("{:.0e}", value) : fmt::format("{:.2f}", value == 0 ? 0.0 : value);
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text + " %";
}

/// An error or a tolerance of a check: relative, but in its unit where zero is expected.
std::string deviation(const Check& check, double value) { return check.expected == 0 ? number(value) : percent(value); }

/// The sources of some checks, each once, in their order.
std::vector<std::string> sources_of(const Checks& checks) {
  std::vector<std::string> sources;
  for (const Check* check : checks) {
    if (!check->source.empty() && std::find(sources.begin(), sources.end(), check->source) == sources.end()) {
      sources.push_back(check->source);
    }
  }
  return sources;
}

std::string row(const Check& check, const std::vector<std::string>& sources) {
  const auto source = std::find(sources.begin(), sources.end(), check.source);
  const bool fails = !check.passed();
  std::string verdict = R"(<td class="v">measured</td>)";
  if (check.is_gate()) {
    verdict = fails ? R"(<td class="v bad">✗ fail</td>)" : R"(<td class="v good">✓ pass</td>)";
  }
  const std::string_view look = fails ? " class=\"fail\"" : check.is_gate() ? "" : " class=\"info\"";
  return fmt::format(
             "<tr{}><td>{}</td><td>{}</td><td class=\"n\">{:g}</td><td>{}</td><td class=\"n\">{}</td>"
             "<td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>",
             look, escaped(check.quantity), escaped(check.model), check.poisson, escaped(check.grid),
             number(check.measured), number(check.expected), escaped(check.unit), deviation(check, check.error()),
             check.is_gate() ? deviation(check, check.tolerance) : "–") +
         verdict +
         (source == sources.end() ? "<td></td>" : fmt::format("<td>[{}]</td>", source - sources.begin() + 1)) +
         "</tr>\n";
}

std::string table(const Checks& checks) {
  if (checks.empty()) return "";
  const std::vector<std::string> sources = sources_of(checks);
  std::string out =
      "<div class=\"table\"><table>\n<thead><tr><th>quantity</th><th>model</th><th class=\"n\">ν</th><th>grid</th>"
      "<th class=\"n\">measured</th><th class=\"n\">expected</th><th>unit</th><th class=\"n\">error</th>"
      "<th class=\"n\">tolerance</th><th>verdict</th><th>source</th></tr></thead>\n<tbody>\n";
  for (const Check* check : checks) out += row(*check, sources);
  out += "</tbody>\n</table></div>\n";
  if (sources.empty()) return out;
  out += "<ul class=\"sources\">\n";
  for (std::size_t i = 0; i < sources.size(); ++i) {
    out += fmt::format("<li>[{}] {}</li>\n", i + 1, escaped(sources[i]));
  }
  return out + "</ul>\n";
}

std::string color_bar(const ColorBar& colors) {
  if (colors.label.empty()) return "";
  std::string stops;
  constexpr int kStops = 8;
  for (int i = 0; i <= kStops; ++i) {
    const Eigen::Vector3f color = 255 * color_scale(static_cast<double>(i) / kStops);
    stops += fmt::format(",rgb({:.0f} {:.0f} {:.0f})", color.x(), color.y(), color.z());
  }
  return fmt::format(
      "<div class=\"bar\">{}<i style=\"background:linear-gradient(90deg{})\"></i>{}<span>{}</span></div>\n",
      number(colors.low), stops, fmt::format("{:.3g}", colors.high), escaped(colors.label));
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
        std::any_of(report.pictures.begin(), report.pictures.end(), is_it)) {
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
    sections += table(checks) + plots_and_pictures(report, one.name) + "</section>\n";
  }
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
             "content=\"width=device-width, initial-scale=1\">\n<title>sprung validate</title>\n<style>{}</style>\n"
             "</head>\n<body>\n",
             kReportStyle) +
         header(report) + contents + "</nav>\n" + plots_and_pictures(report, "") + sections + "</body>\n</html>\n";
}

void write_html_report(const Report& report, const std::filesystem::path& file) {
  write_whole_file(file, html_report(report));
}

}  // namespace sprung
