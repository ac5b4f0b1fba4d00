#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
#include "app/sweep/sweep_plot.h"
#include "app/sweep/sweep_table.h"
#include "app/sweep/swept_values.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SweepOptions {
  std::string input;  // a mesh, a scene or the folder of a sweep
  OutputOptions outputs;
  SettingOptions keys;
  std::vector<Setting> defaults;  // as for a simulation of each scene
  bool table = false;
  std::string plot;  // "tip.displacement.y"
  std::string against;
  bool overwrite = false;
};

/// One combination of values.
using SweptValues = std::vector<Setting>;

std::vector<SweptValues> choices_of(const std::vector<Setting>& settings) {
  std::vector<SweptValues> choices{{}};
  for (const Setting& setting : settings) {
    std::vector<SweptValues> longer;
    for (const SweptValues& choice : choices) {
      for (const std::string& value : values_in(setting.value)) {
        longer.push_back(choice);
        longer.back().push_back({setting.option, setting.key, value});
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

/// Names of equal length for all runs, so that they sort.
std::string name_of_run(std::size_t run) { return fmt::format("{:03}", run + 1); }

std::string quoted(const fs::path& path) { return shell_quoted(path.string()); }

void write_runs(const SweepOptions& options, const Console& console) {
  if (options.outputs.names.size() != 1) throw Error(ErrorKind::kUsage, "sweep writes into one folder: -o FOLDER");
  const fs::path folder = fs::absolute(options.outputs.names.front()).lexically_normal();
  refuse_existing(folder / "commands", options.overwrite);
  const std::vector<SweptValues> choices = choices_of(options.keys.settings());
  std::vector<std::string> scenes;
  scenes.reserve(choices.size());
  for (const SweptValues& choice : choices) {
    scenes.push_back(print_scene(
        with_defaults(make_scene({.input = options.input, .settings = choice, .defaults = options.defaults}))));
  }
  std::string commands;
  Json runs = Json::array();
  for (std::size_t run = 0; run < choices.size(); ++run) {
    const fs::path place = folder / name_of_run(run);
    make_folder(place);
    write_file(place / "scene.toml", scenes[run]);
    // The scenes hold the defaults of the site already.
    commands += fmt::format("{}= sprung simulate {} -o {} -o {} --resume\n", kConfigVariable,
                            quoted(place / "scene.toml"), quoted(place / "run.h5"), quoted(place / ""));
    Json set = Json::object();
    for (const Setting& setting : choices[run]) set[setting.key] = setting.value;
    runs.push_back({{"folder", name_of_run(run)}, {"set", set}});
  }
  write_file(folder / "runs.json", runs.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  write_file(folder / "commands", commands);
  write_file(folder / "run", fmt::format("# All runs one after the other, then their table.\nsh {}\n"
                                         "sprung sweep {} --table | tee {}\n",
                                         quoted(folder / "commands"), quoted(folder), quoted(folder / "table.csv")));
  console.note(count_of(choices.size(), "run"));
  fmt::print("{}\n", (fs::path(options.outputs.names.front()) / "commands").string());
}

void write_plot(const SweepOptions& options, const Console& console) {
  for (const std::string& file : options.outputs.names) {
    const std::string ending = lower_extension(file);
    if (ending != ".svg" && ending != ".html") {
      throw Error(ErrorKind::kUsage, fmt::format("--output {}: a plot is written as .svg or .html", file));
    }
    refuse_existing(file, options.overwrite);
  }
  const SweepTable table = read_sweep_table(options.input, console);
  const Figure figure = sweep_figure(table, options.plot, options.against);
  for (const std::string& file : options.outputs.names) {
    make_folder(fs::path(file).parent_path());
    write_file(file, lower_extension(file) == ".svg" ? svg_text(figure) : sweep_page(table, figure));
  }
  options.outputs.print();
}

}  // namespace

void add_sweep(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("sweep", "a scene and lists of values in, a folder and a command for each run out");
  const auto options = std::make_shared<SweepOptions>();
  options->defaults = default_settings(invocation.defaults, "simulate");
  command->add_option("INPUT", options->input, "a mesh file, a scene (.toml), or the folder of a sweep");
  options->outputs.add_to(*command, "the folder for all runs; of a plot .svg or .html", "OUT");
  options->keys.add_set(*command, invocation, "values of any key of a scene, by commas, or FIRST:LAST:STEP",
                        "KEY=A,B,C");
  command->add_flag("--table", options->table, "the last measurements of the probes of all runs, as CSV");
  CLI::Option* plot =
      command
          ->add_option("--plot", options->plot, "one of these measurements over a swept key, as -o plot.svg or .html")
          ->option_text("PROBE.QUANTITY");
  command->add_option("--against", options->against, "that key; default: the first")->option_text("KEY")->needs(plot);
  command->add_flag("--overwrite", options->overwrite, "replace the list of commands, or the plot, that exists");
  add_messages(*command, invocation.console);
  command->footer(
      "Examples:\n  sprung sweep scene.toml --set body.material=gelatin,rubber -o runs\n  sh runs/commands\n"
      "  sprung sweep runs --table\n  sprung sweep runs --plot tip.displacement.y -o plot.svg");
  command->callback([options, command, &invocation] {
    require_input(*command, options->input, "a mesh or a scene");
    if (options->table) {
      fmt::print("{}", csv_text(read_sweep_table(options->input, invocation.console)));
      return;
    }
    options->outputs.require(*command, options->plot.empty() ? "-o folder/" : "-o plot.svg");
    if (!options->plot.empty()) return write_plot(*options, invocation.console);
    write_runs(*options, invocation.console);
  });
}

}  // namespace sprung
