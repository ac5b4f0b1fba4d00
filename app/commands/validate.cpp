#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/validate/cases.h"
#include "app/validate/report.h"

namespace sprung {
namespace {

struct ValidateOptions {
  std::vector<std::string> cases{};  // names of built-in experiments or scene files; none: all that are built in
  std::string model{};
  std::string poisson{};
  std::string bricks{};
  std::string report{};  // folder; empty: none
  bool list = false;
  bool json = false;
};

/// False if a check fails.
bool validate(const ValidateOptions& options, const Choice& choice, const Console& console) {
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
    CaseResult result = one.run(choice, console);
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

}  // namespace

void add_validate(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("validate", "experiments, measured against theory and reference");
  const auto options = std::make_shared<ValidateOptions>();
  command->add_option("FILES", options->cases, "scenes with [[expect]]; default: the built-in experiments");
  command->add_option("--case", options->cases, "a built-in experiment; may be given several times")
      ->allow_extra_args(false)
      ->option_text("NAME");
  command->add_flag("--list", options->list, "name the built-in experiments, and stop");
  const CLI::Option* model =
      command->add_option("--model", options->model, "this law of the bricks only")->option_text("NAME");
  const CLI::Option* poisson =
      command->add_option("--poisson", options->poisson, "this Poisson's ratio only")->option_text("NU");
  const CLI::Option* bricks =
      command->add_option("--bricks", options->bricks, "this grid only, by the bricks along the longest side")
          ->option_text("N");
  command->add_flag("--json", options->json, "checks as JSON");
  command->add_option("--report", options->report, "folder for report.html")->option_text("DIR");
  add_messages(*command, invocation.console, "say why a model could not be run");
  command->footer(
      "Examples:\n  sprung validate\n  sprung validate --case cantilever --model calibrated\n"
      "  sprung validate mine.toml --report out/report");
  command->callback([options, model, poisson, bricks, &invocation] {
    const Choice choice{.model = key_value<Model>(*model, "body.model", options->model),
                        .poisson = key_value<double>(*poisson, "body.material.poisson", options->poisson),
                        .bricks = key_value<int>(*bricks, "body.bricks", options->bricks)};
    if (!validate(*options, choice, invocation.console)) invocation.exit_code = int(ErrorKind::kFailed);
  });
}

}  // namespace sprung
