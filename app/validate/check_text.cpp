#include "app/validate/check_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "app/json_text.h"

namespace sprung {
namespace {

std::string result_text(const Check& check) {
  if (!check.is_gate()) return "-";
  return check.passed() ? "pass" : "FAIL";
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

std::string tolerance_text(const Check& check) {
  if (!check.is_gate()) return "-";
  return check.expected == 0 ? number(check.tolerance) : fmt::format("{:.3g} %", 100 * check.tolerance);
}

std::string json_object(const Check& check) {
  return fmt::format(
      "  {{\"experiment\": {}, \"quantity\": {}, \"model\": {}, \"poisson\": {}, \"grid\": {}, "
      "\"bricks_across\": {}, \"measured\": {}, \"expected\": {}, \"unit\": {}, \"error\": {}, "
      "\"tolerance\": {}, \"passed\": {}, \"source\": {}}}",
      json_text(check.experiment), json_text(check.quantity), json_text(check.model), json_text(check.poisson),
      json_text(check.grid), json_text(check.bricks_across), json_text(check.measured), json_text(check.expected),
      json_text(check.unit), json_text(check.error()), json_text(check.tolerance),
      check.is_gate() ? (check.passed() ? "true" : "false") : "null", json_text(check.source));
}

}  // namespace

std::string error_text(const Check& check) {
  if (std::isnan(check.error())) return "-";
  return check.expected == 0 ? fmt::format("{:+.2g}", check.error()) : fmt::format("{:+.2f} %", 100 * check.error());
}

std::string check_line(const Check& check) {
  return fmt::format("{:<22} {:<20} {:<10} nu {:<5} {:<8} {:>13} {:>13} {:<4} {:>10} {:>9} {:<4}  {}", check.experiment,
                     check.quantity, check.model, check.poisson, check.grid, number(check.measured),
                     number(check.expected), check.unit, error_text(check), tolerance_text(check), result_text(check),
                     check.source);
}

std::string checks_json(const std::vector<Check>& checks) {
  std::vector<std::string> objects;
  objects.reserve(checks.size());
  for (const Check& check : checks) objects.push_back(json_object(check));
  return fmt::format("[\n{}\n]\n", fmt::join(objects, ",\n"));
}

}  // namespace sprung
