#include "app/commands/validate.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/validate/cases.h"
#include "app/validate/report.h"

namespace sprung {

bool validate(const ValidateOptions& options, const Console& console) {
  const std::vector<Case> cases = find_cases(options.list ? std::vector<std::string>{} : options.cases);
  if (options.list) {
    for (const Case& one : cases) fmt::print("{:<24}{}\n", one.name, one.title);
    return true;
  }
  std::vector<FinishedCase> finished;
  std::vector<Check> checks;
  Progress progress(console, "validate");
  for (const Case& one : cases) {
    console.check_interrupt();
    CaseResult result = one.run(options.choice, console);
    if (result.checks.empty()) console.note(fmt::format("{} does not cover that choice", one.name));
    if (!options.json) {
      for (const Check& check : result.checks) fmt::print("{}\n", check_line(check));
      fmt::print("{}", table_text(result.table));
      std::fflush(stdout);
    }
    checks.insert(checks.end(), result.checks.begin(), result.checks.end());
    finished.push_back({one, std::move(result)});
  }
  if (options.json) fmt::print("{}", checks_json(checks));
  const auto gates = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.is_gate(); });
  const auto failed = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !check.passed(); });
  progress.finish(fmt::format("{} checks, {} of them with a tolerance, {} failed", checks.size(), gates, failed));
  if (!options.report.empty()) make_report(options.report, finished, progress.seconds(), console);
  return failed == 0;
}

}  // namespace sprung
