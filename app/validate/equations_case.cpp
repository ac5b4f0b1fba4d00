#include <fmt/format.h>

#include <cmath>

#include "app/validate/built_in_cases.h"
#include "core/law/equation_count.h"

namespace sprung {
namespace {

constexpr double kTolerance = 1e-9;

std::string ratio_text(const EquationCount& count) {
  if (count.solvable) return "any";
  return count.poisson ? fmt::format("{:.6g} only", *count.poisson) : "none";
}

TextTable table_of(const std::vector<EquationCount>& counts) {
  TextTable table{.head = {"element", "unknowns", "equations", "for E", "for nu", "for G", "rank", "solved for nu"},
                  .rows = {}};
  for (const EquationCount& count : counts) {
    table.rows.push_back({count.name, fmt::format("{}", count.unknowns), fmt::format("{}", count.equations),
                          fmt::format("{}", count.young_equations), fmt::format("{}", count.poisson_equations),
                          fmt::format("{}", count.shear_equations), fmt::format("{}", count.rank), ratio_text(count)});
  }
  return table;
}

/// The one ratio that springs alone can have.
Check ratio_check(const EquationCount& count, bool is_flat) {
  Check check;
  check.experiment = "equations";
  check.quantity = "solvable.poisson";
  check.model = count.name;
  check.measured = *count.poisson;
  check.expected = is_flat ? 1.0 / 3 : 0.25;
  check.poisson = std::round(1e4 * check.expected) / 1e4;
  check.source = is_flat ? "Cauchy: central forces make lambda = G, 1/3 in plane stress"
                         : "Cauchy: central forces make lambda = G, 1/4 in space";
  check.tolerance = kTolerance;
  return check;
}

}  // namespace

CaseResult run_equations(const Choice& choice) {
  if (choice.model || choice.poisson || choice.bricks) return {};
  const std::vector<SpringConfiguration> configurations = table_configurations();
  const std::vector<EquationCount> counts = count_equations(configurations);
  CaseResult result;
  result.table = table_of(counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].poisson) result.checks.push_back(ratio_check(counts[i], configurations[i].dimensions == 2));
  }
  return result;
}

}  // namespace sprung
