#include "app/report/check_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "app/report/svg_plot.h"
#include "app/validate/check_text.h"

namespace sprung {

namespace {

using Checks = std::vector<const Check*>;

constexpr std::size_t kMostRows = 16;  // of a table that is shown unfolded

std::string with_minus(std::string text) {
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, "\u2212");
  return text;
}

/// A share in per cent; tiny ones with their power of ten, since 0.00 would hide them.
std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  const double value = 100 * share;
  const bool tiny = value != 0 && std::abs(value) < 0.005;
  return with_minus(tiny ? fmt::format("{:.1g}", value) : fmt::format("{:.2f}", value == 0 ? 0.0 : value)) + " %";
}

/// An error or a tolerance of a check: relative, but in its unit where zero is expected.
std::string deviation(const Check& check, double value) {
  if (check.expected != 0) return percent(value);
  if (check.unit == "%") return percent(value / 100);
  return std::isfinite(value) ? with_minus(fmt::format("{:.2g}", value)) : "–";
}

/// The sources of some checks, each once, in their order.
std::vector<std::string> sources_of(const Checks& checks) {
  std::vector<std::string> sources;
  for (const Check* check : checks) {
    const std::string source = source_text(*check);
    if (!source.empty() && std::find(sources.begin(), sources.end(), source) == sources.end())
      sources.push_back(source);
  }
  return sources;
}

std::string_view look_of(const Check& check) {
  if (!check.passed()) return "bad";
  return check.is_gate() ? "good" : "info";
}

std::string verdict_cell(const Check& check) {
  if (!check.trouble.empty() && !check.is_gate()) return R"(<td class="v">no result</td>)";
  if (!check.is_gate()) return R"(<td class="v">measured</td>)";
  return check.passed() ? R"(<td class="v good">✓ pass</td>)" : R"(<td class="v bad">✗ fail</td>)";
}

std::string row(const Check& check, const std::vector<std::string>& sources) {
  const auto source = std::find(sources.begin(), sources.end(), source_text(check));
  const std::string_view look = !check.passed() ? " class=\"fail\"" : check.is_gate() ? "" : " class=\"info\"";
  return fmt::format(
             "<tr{}><td>{}</td><td>{}</td><td class=\"n\">{:g}</td><td>{}</td><td class=\"n\">{}</td>"
             "<td class=\"n\">{}{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>",
             look, escaped(check.quantity), escaped(check.model), check.poisson, escaped(check.grid),
             html_number(check.measured), check.is_least ? "≥ " : "", html_number(check.expected), escaped(check.unit),
             check.is_least ? "–" : deviation(check, check.error()),
             check.is_gate() && !check.is_least ? deviation(check, check.tolerance) : "–") +
         verdict_cell(check) +
         (source == sources.end() ? "<td></td>" : fmt::format("<td>[{}]</td>", source - sources.begin() + 1)) +
         "</tr>\n";
}

/// Every measurement, a row each.
std::string full_table(const Checks& checks) {
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

/// What the columns of a matrix differ in, and what its rows say besides quantity, model and source.
struct Layout {
  bool by_ratio = false;    // else by grid
  bool names_rest = false;  // rows name the ratio, or the grid where the columns are ratios
};

std::string ratio_text(const Check& check) { return fmt::format("ν = {:g}", check.poisson); }

/// Errors of checks, a row for each quantity, model and what the layout adds.
class Matrix {
 public:
  Matrix(const Checks& checks, Layout layout) {
    for (const Check* check : checks) {
      std::string rest = layout.by_ratio ? check->grid : ratio_text(*check);
      if (!layout.names_rest) rest.clear();
      const Key key{check->quantity, check->source, std::move(rest), check->model};
      if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) keys_.push_back(key);
      const std::string column = layout.by_ratio ? ratio_text(*check) : check->grid;
      if (std::find(columns_.begin(), columns_.end(), column) == columns_.end()) columns_.push_back(column);
      if (!cells_.try_emplace({key, column}, check).second) is_clear_ = false;
    }
    group();
  }

  /// Whether no two checks want the same place and it saves rows.
  [[nodiscard]] bool is_useful() const { return is_clear_ && columns_.size() > 1 && 2 * keys_.size() <= cells_.size(); }
  [[nodiscard]] std::size_t rows() const { return keys_.size(); }

  [[nodiscard]] std::string html() const {
    std::string out = "<div class=\"table\"><table class=\"matrix\">\n<thead><tr><th>error</th><th>model</th>";
    for (const std::string& column : columns_) out += fmt::format("<th class=\"n\">{}</th>", escaped(column));
    out += "</tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const Key& key = keys_[i];
      const bool is_new = i == 0 || keys_[i - 1][0] != key[0] || keys_[i - 1][1] != key[1];
      if (is_new) {
        out += fmt::format("<tr class=\"of\"><td colspan=\"{}\"><b>{}</b> against {}</td></tr>\n", columns_.size() + 2,
                           escaped(key[0]), escaped(key[1]));
      }
      const bool is_new_rest = is_new || keys_[i - 1][2] != key[2];
      out += fmt::format("<tr{}><td>{}</td><td>{}</td>", is_new_rest && !is_new ? " class=\"first\"" : "",
                         is_new_rest ? escaped(key[2]) : "", escaped(key[3]));
      for (const std::string& column : columns_) out += cell(key, column);
      out += "</tr>\n";
    }
    return out +
           "</tbody>\n</table></div>\n<p class=\"key\"><b class=\"good\">within</b> and <b class=\"bad\">beyond</b> a "
           "tolerance; grey: measured only</p>\n";
  }

 private:
  using Key = std::array<std::string, 4>;  // quantity, source, rest, model

  /// Rows of one quantity stand together, and in it those of one rest; else the order stays.
  void group() {
    const std::vector<Key> before = keys_;
    const auto rank = [&](const Key& key, std::size_t depth) {
      return std::find_if(before.begin(), before.end(), [&](const Key& other) {
        return std::equal(key.begin(), key.begin() + std::ptrdiff_t(depth), other.begin());
      });
    };
    std::stable_sort(keys_.begin(), keys_.end(), [&](const Key& a, const Key& b) {
      return std::pair(rank(a, 2), rank(a, 3)) < std::pair(rank(b, 2), rank(b, 3));
    });
  }

  [[nodiscard]] std::string cell(const Key& key, const std::string& column) const {
    const auto found = cells_.find({key, column});
    if (found == cells_.end()) return "<td></td>";
    const Check& check = *found->second;
    const std::string text = check.trouble.empty() ? deviation(check, check.error()) : "no result";
    return fmt::format("<td class=\"n {}\">{}</td>", look_of(check), text);
  }

  std::vector<Key> keys_;
  std::vector<std::string> columns_;
  std::map<std::pair<Key, std::string>, const Check*> cells_;
  bool is_clear_ = true;
};

/// The shortest matrix that holds them all.
std::optional<Matrix> matrix_of(const Checks& checks) {
  std::optional<Matrix> best;
  for (const Layout layout : {Layout{true, false}, Layout{false, true}, Layout{true, true}}) {
    Matrix matrix(checks, layout);
    if (matrix.is_useful() && (!best || matrix.rows() < best->rows())) best = std::move(matrix);
  }
  return best;
}

}  // namespace

std::string html_number(double value) { return std::isfinite(value) ? with_minus(fmt::format("{:.5g}", value)) : "–"; }

std::string html_checks(const std::vector<const Check*>& checks) {
  if (checks.empty()) return "";
  Checks varied;  // bounds are one a model, whatever varies
  std::copy_if(checks.begin(), checks.end(), std::back_inserter(varied), [](const Check* c) { return !c->is_least; });
  const std::optional<Matrix> matrix = matrix_of(varied);
  if (!matrix && checks.size() <= kMostRows) return full_table(checks);
  return fmt::format(
      "{}<details><summary>all {} measurements, with what was expected and from where</summary>\n{}</details>\n",
      matrix ? matrix->html() : "", checks.size(), full_table(checks));
}

std::string html_table(const TextTable& table) {
  if (table.rows.empty()) return "";
  std::string out = "<div class=\"table\"><table>\n<thead><tr>";
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    out += fmt::format("<th{}>{}</th>", i == 0 ? "" : " class=\"n\"", escaped(table.head[i]));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& cells : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      out += fmt::format("<td{}>{}</td>", i == 0 ? "" : " class=\"n\"", escaped(with_minus(cells[i])));
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table></div>\n";
}

}  // namespace sprung
