#include "app/validate/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <span>

#include "app/validate/plots.h"
#include "core/files.h"
#include "core/text.h"
#include "render/image/color_map.h"
#include "render/image/png.h"

namespace sprung {
namespace {

constexpr std::size_t kMaxRows = 16;  // of a table that is not folded

/// `look` is a list of classes of the style sheet.
struct PageCell {
  std::string html{};
  std::string_view look{};
};

struct PageRow {
  std::vector<PageCell> cells{};  // a single one spans the table
  std::string_view look{};
};

std::string tag(std::string_view name, const PageCell& cell, std::size_t span = 1) {
  return fmt::format("<{0}{1}{2}>{3}</{0}>", name, cell.look.empty() ? "" : fmt::format(" class=\"{}\"", cell.look),
                     span == 1 ? "" : fmt::format(" colspan=\"{}\"", span), cell.html);
}

std::string html_table(std::string_view look, const std::vector<PageCell>& head, const std::vector<PageRow>& rows) {
  const auto line = [&](std::string_view name, const PageRow& row) {
    std::string cells;
    for (const PageCell& cell : row.cells) cells += tag(name, cell, row.cells.size() == 1 ? head.size() : 1);
    return tag("tr", {cells, row.look}) + "\n";
  };
  std::string body;
  for (const PageRow& row : rows) body += line("td", row);
  const std::string table = fmt::format("<thead>{}</thead>\n<tbody>\n{}</tbody>\n", line("th", {head}), body);
  return tag("div", {tag("table", {table, look}), "table"}) + "\n";
}

std::string html_table(const TextTable& table) {
  if (table.rows.empty()) return "";
  const auto cells = [](const std::vector<std::string>& words, bool is_head) {
    std::vector<PageCell> row;
    row.reserve(words.size());
    for (const std::string& word : words) {
      row.push_back({escaped(is_head ? word : with_minus(word)), row.empty() ? "" : "n"});
    }
    return row;
  };
  std::vector<PageRow> rows;
  for (const std::vector<std::string>& words : table.rows) rows.push_back({cells(words, false)});
  return html_table("", cells(table.head, true), rows);
}

/// Every check in a row, then the numbered sources.
std::string full_table(const std::vector<Check>& checks) {
  std::vector<std::string> sources;
  std::vector<PageRow> rows;
  for (const Check& check : checks) {
    auto source = std::find(sources.begin(), sources.end(), source_text(check));
    if (source == sources.end()) source = sources.insert(source, source_text(check));
    const PageCell result = !check.passed()         ? PageCell{"✗ fail", "v bad"}
                            : check.is_gate()       ? PageCell{"✓ pass", "v good"}
                            : check.trouble.empty() ? PageCell{"no tolerance", "v"}
                                                    : PageCell{"no result", "v"};
    rows.push_back({{{escaped(check.quantity)},
                     {escaped(check.model)},
                     {with_minus(number_text(check.poisson)), "n"},
                     {escaped(check.grid)},
                     {with_minus(number_text(check.measured)), "n"},
                     {with_minus(number_text(check.expected)), "n"},
                     {escaped(check.unit)},
                     {with_minus(error_text(check)), "n"},
                     {tolerance_text(check), "n"},
                     result,
                     {fmt::format("[{}]", source - sources.begin() + 1)}},
                    !check.passed()   ? "fail"
                    : check.is_gate() ? ""
                                      : "info"});
  }
  std::string list;
  for (std::size_t i = 0; i < sources.size(); ++i)
    list += fmt::format("<li>[{}] {}</li>\n", i + 1, escaped(sources[i]));
  return html_table("",
                    {{"quantity"},
                     {"model"},
                     {"ν", "n"},
                     {"grid"},
                     {"measured", "n"},
                     {"expected", "n"},
                     {"unit"},
                     {"error", "n"},
                     {"tolerance", "n"},
                     {"result"},
                     {"source"}},
                    rows) +
         tag("ul", {list, "sources"}) + "\n";
}

/// The errors of some checks: a row for each model, a column for each grid or each Poisson's ratio.
struct Matrix {
  using Key = std::array<std::string, 4>;  // quantity, source, grid or ratio where rows name it, model

  /// `rows_name_rest`: rows are split by what the columns are not, ratio or grid.
  Matrix(const std::vector<Check>& checks, bool by_ratio, bool rows_name_rest) {
    const auto add_once = [](auto& list, const auto& value) {
      if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
    };
    for (const Check& check : checks) {
      const std::string ratio = fmt::format("ν = {:g}", check.poisson);
      const std::string column = by_ratio ? ratio : check.grid;
      const Key key{check.quantity, check.source, rows_name_rest ? (by_ratio ? check.grid : ratio) : "", check.model};
      add_once(columns, column);
      add_once(keys, key);
      is_unique = cells.try_emplace({key, column}, &check).second && is_unique;
    }
    // Groups the rows by quantity and source, then by grid or ratio, each in the order of its first check.
    const auto place = [before = keys](const Key& key, std::ptrdiff_t depth) {
      const auto is_alike = [&](const Key& other) {
        return std::equal(key.begin(), key.begin() + depth, other.begin());
      };
      return std::find_if(before.begin(), before.end(), is_alike);
    };
    std::stable_sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
      return std::pair(place(a, 2), place(a, 3)) < std::pair(place(b, 2), place(b, 3));
    });
  }

  /// Every check has a cell of its own, and there are at most half as many rows as checks.
  [[nodiscard]] bool is_useful() const { return is_unique && columns.size() > 1 && 2 * keys.size() <= cells.size(); }

  [[nodiscard]] std::string html() const {
    std::vector<PageCell> head{{"error"}, {"model"}};
    for (const std::string& column : columns) head.push_back({escaped(column), "n"});
    std::vector<PageRow> rows;
    Key last;
    for (const Key& key : keys) {
      const bool is_new = rows.empty() || !std::equal(key.begin(), key.begin() + 2, last.begin());
      const bool is_new_rest = is_new || key[2] != last[2];
      if (is_new) rows.push_back({{{fmt::format("<b>{}</b> against {}", escaped(key[0]), escaped(key[1]))}}, "of"});
      PageRow& row = rows.emplace_back();
      row.look = is_new_rest && !is_new ? "first" : "";
      row.cells = {{is_new_rest ? escaped(key[2]) : ""}, {escaped(key[3])}};
      for (const std::string& column : columns) row.cells.push_back(cell(key, column));
      last = key;
    }
    return html_table("matrix", head, rows) +
           "<p class=\"key\"><b class=\"good\">green</b>: within the tolerance; <b class=\"bad\">red</b>: outside; "
           "grey: "
           "no tolerance</p>\n";
  }

  [[nodiscard]] PageCell cell(const Key& key, const std::string& column) const {
    const auto found = cells.find({key, column});
    if (found == cells.end()) return {};
    const Check& check = *found->second;
    const std::string text = check.trouble.empty() ? with_minus(error_text(check)) : "no result";
    return {text, !check.passed() ? "n bad" : check.is_gate() ? "n good" : "n info"};
  }

  std::vector<Key> keys;
  std::vector<std::string> columns;
  std::map<std::pair<Key, std::string>, const Check*> cells;
  bool is_unique = true;
};

/// The shortest useful matrix of errors, if there is one, and the table of all checks, folded if it is long.
std::string html_checks(const std::vector<Check>& checks) {
  if (checks.empty()) return "";
  std::optional<Matrix> best;
  for (const auto& [by_ratio, rows_name_rest] : {std::pair(true, false), {false, true}, {true, true}}) {
    Matrix matrix(checks, by_ratio, rows_name_rest);
    if (matrix.is_useful() && (!best || matrix.keys.size() < best->keys.size())) best = std::move(matrix);
  }
  if (!best && checks.size() <= kMaxRows) return full_table(checks);
  return fmt::format(
      "{}<details><summary>all {} measurements with expected values and sources</summary>\n{}</details>\n",
      best ? best->html() : "", checks.size(), full_table(checks));
}

std::string html_figures(const std::vector<Figure>& figures) {
  std::string out;
  for (const Figure& figure : figures) {
    out += tag("figure", {svg_text(figure) + tag("figcaption", {escaped(figure.caption)})}) + "\n";
  }
  return out;
}

std::string html_picture(const CasePicture& picture) {
  const BodyPicture& drawn = picture.picture;
  const std::vector<std::uint8_t> png = encode_png(drawn.image);
  constexpr int kStops = 8;
  std::string stops;
  for (int i = 0; i <= kStops; ++i) {
    const Eigen::Vector3f color = 255 * map_color(ColorMap::kViridis, double(i) / kStops);
    stops += fmt::format(",rgb({:.0f} {:.0f} {:.0f})", color.x(), color.y(), color.z());
  }
  return fmt::format(
      "<figure><img alt=\"{0}\" width=\"{1}\" height=\"{2}\" src=\"data:image/png;base64,{3}\">\n"
      "<div class=\"bar\">{4:g}<i style=\"background:linear-gradient(90deg{5})\"></i>{6:.3g}<span>{7}</span></div>\n"
      "<figcaption>{0}</figcaption></figure>\n",
      escaped(picture.caption), drawn.image.width, drawn.image.height, base64(std::as_bytes(std::span(png))), drawn.low,
      stops, drawn.high, escaped(drawn.quantity));
}

struct Tally {
  std::ptrdiff_t passed = 0;
  std::ptrdiff_t failed = 0;
  std::ptrdiff_t reported = 0;  // without a tolerance

  void add(const Check& check) { ++(!check.passed() ? failed : check.is_gate() ? passed : reported); }
};

/// "✓ 12 passed", "✗ 1 of 13 failed", "3 reported".
std::string html_tally(const CaseResult& result) {
  Tally tally;
  for (const Check& check : result.checks) tally.add(check);
  if (tally.failed > 0) {
    return tag("span", {fmt::format("✗ {} of {} failed", tally.failed, tally.passed + tally.failed), "bad"});
  }
  if (tally.passed > 0) return tag("span", {fmt::format("✓ {} passed", tally.passed), "good"});
  return tally.reported > 0 ? tag("span", {fmt::format("{} reported", tally.reported)}) : "";
}

void replace_part(std::string& page, std::string_view part, const std::string& html) {
  const std::string comment = fmt::format("<!--{}-->", part);
  page.replace(page.find(comment), comment.size(), html);
}

}  // namespace

std::string html_report(const Report& report) {
  Tally sum;
  std::string contents;
  std::string sections;
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const ReportSection& section = report.sections[i];
    const std::vector<Check>& checks = section.result.checks;
    for (const Check& check : checks) sum.add(check);
    std::string shown = html_table(section.result.table) + html_checks(checks) + html_figures(section.figures);
    if (section.picture) shown += tag("div", {html_picture(*section.picture), "pictures"}) + "\n";
    if (shown.empty()) continue;
    contents += fmt::format("<a href=\"#case{}\"><span>{}</span>{}</a>\n", i, escaped(section.title),
                            html_tally(section.result));
    sections += fmt::format("<section id=\"case{}\">\n<h2>{}</h2>\n{}{}</section>\n", i, escaped(section.title),
                            section.about.empty() ? "" : tag("p", {escaped(section.about), "what"}) + "\n", shown);
  }
  const std::string summary = fmt::format(
      "<p class=\"made\">version {}{}{} · {:.1f} s</p>\n<div class=\"tally\"><div><b class=\"good\">{}</b><span>passed"
      "</span></div><div><b{}>{}</b><span>failed</span></div><div><b>{}</b><span>without tolerance</span></div></div>",
      SPRUNG_VERSION, report.date.empty() ? "" : " · ", escaped(report.date), report.seconds, sum.passed,
      sum.failed > 0 ? " class=\"bad\"" : "", sum.failed, sum.reported);
  std::string page(report_template());
  replace_part(page, "summary", summary);
  replace_part(page, "contents", contents);
  replace_part(page, "figures", html_figures(report.figures));
  replace_part(page, "sections", sections);
  return page;
}

void make_report(const std::filesystem::path& folder, const std::vector<FinishedCase>& cases, double seconds,
                 const Observer& observer) {
  Progress progress(observer, "report", double(cases.size()));
  make_folder(folder);
  Report report{.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr))), .seconds = seconds};
  const auto write = [&](Figure figure, std::vector<Figure>& figures) {
    write_file(folder / (figure.name + ".svg"), svg_text(figure));
    figures.push_back(std::move(figure));
  };
  for (const FinishedCase& one : cases) {
    observer.check_interrupt();
    const Case& shown = one.definition;
    ReportSection& section =
        report.sections.emplace_back(ReportSection{.title = shown.title, .about = shown.about, .result = one.result});
    if (shown.draw) section.picture = shown.draw();
    if (shown.name == "cantilever") {
      write(convergence_figure(one.result.checks), report.figures);
      write(node_error_figure(one.result.node_errors), section.figures);
    }
    if (shown.name == "uniaxial") write(stress_stretch_figure(), section.figures);
    progress.update(double(report.sections.size()));
  }
  write(incompressibility_figure(), report.figures);
  write_file(folder / "report.html", html_report(report));
  progress.finish((folder / "report.html").string());
}

}  // namespace sprung
