#include "app/validate/validate.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/progress.h"
#include "app/validate/check_text.h"
#include "app/validate/experiment_files.h"
#include "app/validate/make_report.h"
#include "app/validate/sheet_experiments.h"

namespace sprung {
namespace {

/// What to run.
struct Selection {
  std::vector<SheetExperiment> sheets;
  std::vector<NamedScene> scenes;
};

Selection select(const ValidateOptions& options) {
  Selection selection;
  std::vector<std::string> scenes;
  for (const std::string& word : options.cases) {
    const auto is_word = [&](const SheetExperiment& sheet) { return sheet.name == word; };
    const auto found = std::find_if(sheet_experiments().begin(), sheet_experiments().end(), is_word);
    if (found == sheet_experiments().end()) {
      scenes.push_back(word);
    } else {
      selection.sheets.push_back(*found);
    }
  }
  const bool is_all = options.cases.empty();
  // A choice speaks of bricks, which sheets have none of.
  const bool is_of_bricks = options.choice.model || options.choice.poisson || options.choice.bricks;
  if (is_all && !is_of_bricks) selection.sheets.assign(sheet_experiments().begin(), sheet_experiments().end());
  if (is_all || !scenes.empty()) selection.scenes = read_experiments(scenes);
  return selection;
}

void print_list() {
  const Selection all = select({});
  for (const NamedScene& scene : all.scenes) fmt::print("{:<24}{}\n", scene.name, scene.scene.experiment.title);
  for (const SheetExperiment& sheet : all.sheets) fmt::print("{:<24}{}\n", sheet.name, sheet.title);
}

}  // namespace

bool validate(const ValidateOptions& options, const Console& console) {
  if (options.list) {
    print_list();
    return true;
  }
  const Selection selection = select(options);
  std::vector<Check> checks;
  const auto add = [&](const std::vector<Check>& more) {
    for (const Check& check : more) {
      if (!options.json) fmt::print("{}\n", check_line(check));
      checks.push_back(check);
    }
    std::fflush(stdout);
  };
  Progress progress(console, "validate");
  for (const NamedScene& scene : selection.scenes) {
    add(run_experiment(scene.name, scene.scene, options.choice, console));
  }
  for (const SheetExperiment& sheet : selection.sheets) add(sheet.run());
  if (options.json) fmt::print("{}", checks_json(checks));
  const auto gates = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.is_gate(); });
  const auto failed = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !check.passed(); });
  progress.finish(fmt::format("{} checks, {} of them gates, {} failed", checks.size(), gates, failed));
  if (!options.report.empty()) make_report(options.report, selection.scenes, checks, progress.seconds(), console);
  return failed == 0;
}

}  // namespace sprung
