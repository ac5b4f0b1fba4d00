#include <fmt/format.h>

#include <algorithm>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/console/interrupt.h"
#include "app/validate/built_in_cases.h"
#include "app/validate/check_text.h"
#include "app/validate/experiment_files.h"
#include "app/validate/make_report.h"
#include "app/validate/run_experiment.h"

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

/// What to run.
struct Chosen {
  std::vector<NamedScene> scenes;
  std::vector<BuiltInCase> built_in;
};

Chosen select(const ValidateOptions& options) {
  Chosen chosen;
  std::vector<std::string> scenes;
  for (const std::string& word : options.cases) {
    const auto is_word = [&](const BuiltInCase& known) { return known.name == word; };
    const auto found = std::find_if(built_in_cases().begin(), built_in_cases().end(), is_word);
    if (found == built_in_cases().end()) {
      scenes.push_back(word);
    } else {
      chosen.built_in.push_back(*found);
    }
  }
  const bool is_all = options.cases.empty();
  if (is_all) chosen.built_in.assign(built_in_cases().begin(), built_in_cases().end());
  if (is_all || !scenes.empty()) chosen.scenes = read_experiments(scenes);
  return chosen;
}

void print_list() {
  const Chosen all = select({});
  for (const NamedScene& scene : all.scenes) fmt::print("{:<24}{}\n", scene.name, scene.scene.experiment.title);
  for (const BuiltInCase& known : all.built_in) fmt::print("{:<24}{}\n", known.name, known.title);
}

void print(const CaseResult& result) {
  for (const Check& check : result.checks) fmt::print("{}\n", check_line(check));
  fmt::print("{}", table_text(result.table));
  std::fflush(stdout);
}

/// False where any gate fails.
bool validate(const ValidateOptions& options, const Choice& choice, const Console& console) {
  if (options.list) {
    print_list();
    return true;
  }
  const Chosen chosen = select(options);
  std::vector<FinishedCase> finished;
  std::vector<Check> checks;
  const auto add = [&](FinishedCase one) {
    if (one.result.checks.empty()) console.note(fmt::format("{} has no case for that choice", one.name));
    if (!options.json) print(one.result);
    checks.insert(checks.end(), one.result.checks.begin(), one.result.checks.end());
    finished.push_back(std::move(one));
  };
  Progress progress(console, "validate");
  for (const NamedScene& scene : chosen.scenes) {
    add({.name = scene.name,
         .result = run_experiment(scene.name, scene.scene, choice, console),
         .scene = &scene.scene});
  }
  for (const BuiltInCase& known : chosen.built_in) {
    stop_if_interrupted();
    add({.name = std::string(known.name), .result = known.run(choice), .built_in = &known});
  }
  if (options.json) fmt::print("{}", checks_json(checks));
  const auto gates = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.is_gate(); });
  const auto failed = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !check.passed(); });
  progress.finish(fmt::format("{} checks, {} of them gates, {} failed", checks.size(), gates, failed));
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
