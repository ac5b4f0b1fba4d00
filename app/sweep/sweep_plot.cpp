#include "app/sweep/sweep_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <optional>

#include "app/scene/probe_columns.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

using Column = SweepTable::Column;

constexpr std::array<std::string_view, 6> kInks{ink::kBlue,   ink::kVermilion, ink::kGreen,
                                                ink::kPurple, ink::kOrange,    ink::kSky};
constexpr std::array<Marker, 3> kMarkers{Marker::kCircle, Marker::kSquare, Marker::kDiamond};

std::optional<double> number_of(const std::string& cell) {
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return number;
}

bool are_numbers(const Column& column) {
  return std::all_of(column.cells.begin(), column.cells.end(), [](const std::string& cell) { return number_of(cell); });
}

const Column& column_at(const SweepTable& table, std::string_view name, std::string_view option) {
  const auto is_named = [&](const Column& column) {
    return column.name == name || column_name(column.name, column.unit) == name;
  };
  const auto found = std::find_if(table.columns.begin(), table.columns.end(), is_named);
  if (found != table.columns.end()) return *found;
  std::vector<std::string_view> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  throw Error(ErrorKind::kUsage, fmt::format("{} {}: the table has {}{}", option, name, fmt::join(names, ", "),
                                             did_you_mean(name, names)));
}

std::string label_of(const Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{} ({})", column.name, column.unit);
}

/// The position of each run on the axis of a key.
struct Places {
  Axis axis;
  std::vector<double> of_runs;
};

Places places_of(const Column& key) {
  Places places{.axis = {.label = label_of(key)}, .of_runs = {}};
  if (are_numbers(key)) {
    for (const std::string& cell : key.cells) places.of_runs.push_back(*number_of(cell));
    return places;
  }
  std::vector<std::string> values;
  for (const std::string& cell : key.cells) {
    const auto known = std::find(values.begin(), values.end(), cell);
    places.of_runs.push_back(double(known - values.begin()) + 1);
    if (known == values.end()) values.push_back(cell);
  }
  places.axis.label += ":";
  for (std::size_t i = 0; i < values.size(); ++i) {
    places.axis.label += fmt::format("{} {} {}", i == 0 ? "" : ",", i + 1, values[i]);
    places.axis.ticks.push_back(double(i + 1));
  }
  return places;
}

/// The other settings of a run: "gravity = [0,0,0], body.bricks = 8".
std::string others_of(const SweepTable& table, std::size_t run, const Column& key) {
  std::string text;
  for (std::size_t i = 1; i <= table.swept; ++i) {
    const Column& column = table.columns[i];
    if (&column == &key ||
        std::count(column.cells.begin(), column.cells.end(), column.cells[run]) == std::ssize(column.cells))
      continue;
    text += fmt::format("{}{} = {}{}{}", text.empty() ? "" : ", ", column.name, column.cells[run],
                        column.unit.empty() ? "" : " ", column.unit);
  }
  return text;
}

std::string html_row(const SweepTable& table, std::string_view tag,
                     const std::function<std::string(const Column&)>& of) {
  std::string row = "<tr>";
  for (const Column& column : table.columns) row += fmt::format("<{0}>{1}</{0}>", tag, escaped(of(column)));
  return row + "</tr>\n";
}

}  // namespace

Figure sweep_figure(const SweepTable& table, std::string_view measured, std::string_view key) {
  const Column& y = column_at(table, measured, "--plot");
  const Column& x = key.empty() ? table.columns[1] : column_at(table, key, "--against");
  if (x.cells.empty()) throw Error(ErrorKind::kBadInput, "no run of the sweep has begun");
  if (!are_numbers(y)) throw Error(ErrorKind::kUsage, fmt::format("--plot {}: these are no numbers", measured));
  const Places places = places_of(x);
  std::map<std::string, std::vector<Eigen::Vector2d>> curves;
  for (std::size_t run = 0; run < x.cells.size(); ++run) {
    curves[others_of(table, run, x)].emplace_back(places.of_runs[run], *number_of(y.cells[run]));
  }
  SvgPlot plot{.x = places.axis, .y = {.label = label_of(y)}};
  for (auto& [name, points] : curves) {
    const std::size_t number = plot.curves.size();
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    plot.curves.push_back({.name = name,
                           .points = points,
                           .color = kInks[number % kInks.size()],
                           .marker = kMarkers[number / kInks.size() % kMarkers.size()],
                           .width = are_numbers(x) ? 2.0 : 0.0});
  }
  return {.name = "sweep", .title = label_of(y), .subtitle = fmt::format("over {}", x.name), .plots = {plot}};
}

std::string sweep_page(const SweepTable& table, const Figure& figure) {
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>\n"
      "body {{ font: 15px/1.5 sans-serif; margin: 2em auto; max-width: 60em; color: #1b1b1b }}\n"
      "svg {{ max-width: 100%; height: auto }}\n"
      ".table {{ overflow-x: auto }}\ntable {{ border-collapse: collapse; font-size: 13px }}\n"
      "th, td {{ padding: 0.2em 0.8em; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap }}\n"
      "</style></head><body>\n{}\n<div class=\"table\"><table>\n",
      escaped(figure.title), svg_text(figure));
  page += html_row(table, "th", label_of);
  for (std::size_t run = 0; run < table.columns.front().cells.size(); ++run) {
    page += html_row(table, "td", [run](const Column& column) { return column.cells[run]; });
  }
  return page + "</table></div>\n</body></html>\n";
}

}  // namespace sprung
