#include "app/validate/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung {
namespace {

std::string result_text(const Check& check) {
  if (!check.is_gate()) return check.trouble.empty() ? "-" : "none";
  return check.passed() ? "pass" : "FAIL";
}

}  // namespace

double Check::error() const { return expected == 0 ? measured : measured / expected - 1; }

bool Check::is_gate() const { return !std::isnan(tolerance); }

/// NaN compares false, so that a failed run fails its gates.
bool Check::passed() const { return !is_gate() || std::abs(error()) <= tolerance; }

std::string number_text(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

std::string error_text(const Check& check) {
  const double error = check.error();
  if (std::isnan(error)) return "-";
  if (check.expected == 0 && check.unit != "%") return fmt::format("{:.2g}", error);
  const double percent = check.expected == 0 ? error : 100 * error;
  const bool is_tiny = percent != 0 && std::abs(percent) < 0.005;  // 0.00 would hide it
  return is_tiny ? fmt::format("{:.1g} %", percent) : fmt::format("{:.2f} %", percent);
}

std::string tolerance_text(const Check& check) {
  if (!check.is_gate()) return "-";
  return check.expected == 0 ? number_text(check.tolerance) : fmt::format("{:.3g} %", 100 * check.tolerance);
}

std::string source_text(const Check& check) {
  return check.trouble.empty() ? check.source : fmt::format("{}; not measured: {}", check.source, check.trouble);
}

std::string check_line(const Check& check) {
  return fmt::format("{:<22} {:<20} {:<10} nu {:<5} {:<8} {:>13} {:>13} {:<4} {:>10} {:>9} {:<4}  {}", check.experiment,
                     check.quantity, check.model, check.poisson, check.grid, number_text(check.measured),
                     number_text(check.expected), check.unit,
                     fmt::format("{}{}", check.error() > 0 ? "+" : "", error_text(check)), tolerance_text(check),
                     result_text(check), source_text(check));
}

std::string table_text(const TextTable& table) {
  if (table.rows.empty()) return "";
  std::vector<std::vector<std::string>> rows{table.head};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> widths(table.head.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += '\n';
  }
  return text;
}

std::string checks_json(const std::vector<Check>& checks) {
  using Json = nlohmann::ordered_json;
  Json array = Json::array();
  for (const Check& check : checks) {
    array.push_back({{"experiment", check.experiment},
                     {"quantity", check.quantity},
                     {"model", check.model},
                     {"poisson", check.poisson},
                     {"grid", check.grid},
                     {"bricks_across", check.bricks_across},
                     {"measured", check.measured},
                     {"expected", check.expected},
                     {"unit", check.unit},
                     {"error", check.error()},
                     {"tolerance", check.tolerance},
                     {"passed", check.is_gate() ? Json(check.passed()) : Json()},
                     {"trouble", check.trouble},
                     {"source", check.source}});
  }
  return array.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sprung
