#include "app/validate/check_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/console/json_text.h"

namespace sprung {
namespace {

std::string result_text(const Check& check) {
  if (!check.is_gate()) return check.trouble.empty() ? "-" : "none";
  return check.passed() ? "pass" : "FAIL";
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

std::string tolerance_text(const Check& check) {
  if (!check.is_gate()) return "-";
  return check.expected == 0 ? number(check.tolerance) : fmt::format("{:.3g} %", 100 * check.tolerance);
}

std::string expected_text(const Check& check) { return (check.is_least ? ">= " : "") + number(check.expected); }

std::string json_object(const Check& check) {
  return fmt::format(
      "  {{\"experiment\": {}, \"quantity\": {}, \"model\": {}, \"poisson\": {}, \"grid\": {}, "
      "\"bricks_across\": {}, \"measured\": {}, \"expected\": {}, \"unit\": {}, \"error\": {}, "
      "\"tolerance\": {}, \"is_least\": {}, \"passed\": {}, \"trouble\": {}, \"source\": {}}}",
      json_text(check.experiment), json_text(check.quantity), json_text(check.model), json_text(check.poisson),
      json_text(check.grid), json_text(check.bricks_across), json_text(check.measured), json_text(check.expected),
      json_text(check.unit), json_text(check.error()), json_text(check.tolerance), check.is_least,
      check.is_gate() ? (check.passed() ? "true" : "false") : "null", json_text(check.trouble),
      json_text(check.source));
}

}  // namespace

std::string error_text(const Check& check) {
  if (std::isnan(check.error())) return "-";
  return check.expected == 0 ? fmt::format("{:+.2g}", check.error()) : fmt::format("{:+.2f} %", 100 * check.error());
}

std::string check_line(const Check& check) {
  return fmt::format("{:<22} {:<20} {:<10} nu {:<5} {:<8} {:>13} {:>13} {:<4} {:>10} {:>9} {:<4}  {}", check.experiment,
                     check.quantity, check.model, check.poisson, check.grid, number(check.measured),
                     expected_text(check), check.unit, error_text(check), tolerance_text(check), result_text(check),
                     source_text(check));
}

std::string source_text(const Check& check) {
  return check.trouble.empty() ? check.source : fmt::format("{}; not measured: {}", check.source, check.trouble);
}

std::string table_text(const TextTable& table) {
  if (table.rows.empty()) return "";
  std::vector<std::size_t> widths;
  for (const std::string& word : table.head) widths.push_back(word.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  const auto line = [&](const std::vector<std::string>& row) {
    std::string text = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    return text + "\n";
  };
  std::string text = line(table.head);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string checks_json(const std::vector<Check>& checks) {
  std::vector<std::string> objects;
  objects.reserve(checks.size());
  for (const Check& check : checks) objects.push_back(json_object(check));
  return fmt::format("[\n{}\n]\n", fmt::join(objects, ",\n"));
}

}  // namespace sprung
