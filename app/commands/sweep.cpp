#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
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
  bool table = false;
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

/// Of the same length for every run, so that they sort.
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
    scenes.push_back(print_scene(with_defaults(make_scene({.input = options.input, .settings = choice}))));
  }
  std::string commands;
  Json runs = Json::array();
  for (std::size_t run = 0; run < choices.size(); ++run) {
    const fs::path place = folder / name_of_run(run);
    make_folder(place);
    write_file(place / "scene.toml", scenes[run]);
    commands += fmt::format("sprung simulate {} -o {} -o {} --resume\n", quoted(place / "scene.toml"),
                            quoted(place / "run.h5"), quoted(place / ""));
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

void print_header(const CacheHeader& header) {
  fmt::print("run,frames,seconds,{},state_hash", header.progress_name);
  for (const Probe& probe : cached_film(header).probes) {
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      if (!quantity.is_of(probe.kind())) continue;
      for (std::size_t number = 0; number < quantity.size(); ++number) {
        fmt::print(",{}.{}", probe.name, quantity.label(number));
      }
    }
  }
  fmt::print("\n");
}

void print_row(const std::string& run, const CacheReader& cache) {
  const CachedFrame last = cache.frame(cache.frame_count() - 1);
  double seconds = 0;
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) seconds += cache.frame(frame).seconds;
  fmt::print("{},{},{:.3f},{},{:016x}", run, cache.frame_count(), seconds, last.progress, last.state_hash);
  const std::vector<Probe> probes = cached_film(cache.header()).probes;
  for (std::size_t probe = 0; probe < probes.size(); ++probe) {
    const ProbeSample sample = sample_of(last, probe);
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      if (quantity.is_of(probes[probe].kind())) fmt::print(",{}", fmt::join(quantity.of(sample), ","));
    }
  }
  fmt::print("\n");
}

void print_table(const SweepOptions& options, const Console& console) {
  const fs::path folder = options.input;
  if (!fs::exists(folder / "runs.json")) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("'{}' is not the folder of a sweep: it has no runs.json", options.input));
  }
  bool has_header = false;
  for (std::size_t run = 0; fs::exists(folder / name_of_run(run) / "scene.toml"); ++run) {
    const std::string name = name_of_run(run);
    const fs::path file = folder / name / "run.h5";
    if (!fs::exists(file)) {
      console.warn(fmt::format("run {} is not begun", name));
      continue;
    }
    const CacheReader cache(file);
    const Film film = cached_film(cache.header());
    const int planned = frame_count(film);
    if (int(cache.frame_count()) < planned && !film.until_still) {
      console.warn(fmt::format("run {} has {} of its {} frames", name, cache.frame_count(), planned));
    }
    if (!has_header) print_header(cache.header());
    has_header = true;
    print_row(name, cache);
  }
}

}  // namespace

std::vector<std::string> values_in(std::string_view text) {
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char letter : text) {
    if (letter == '[' || letter == '{') ++depth;
    if (letter == ']' || letter == '}') --depth;
    if (letter == ',' && depth == 0) {
      values.emplace_back();
    } else {
      values.back() += letter;
    }
  }
  return values;
}

void add_sweep(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("sweep", "a scene and lists of values in, a folder and a command for each run out");
  const auto options = std::make_shared<SweepOptions>();
  command->add_option("INPUT", options->input, "a mesh file, a scene (.toml), or with --table the folder of a sweep");
  options->outputs.add_to(*command, "the folder for all runs", "FOLDER");
  options->keys.add_set(*command, "values of any key of a scene, by commas", "KEY=A,B,C");
  command->add_flag("--table", options->table, "the last measurements of the probes of all runs, as CSV");
  command->add_flag("--overwrite", options->overwrite, "replace the list of commands that exists");
  add_messages(*command, invocation.console);
  command->footer(
      "Examples:\n  sprung sweep scene.toml --set body.material=gelatin,rubber -o runs\n  sh runs/commands\n"
      "  sprung sweep runs --table");
  command->callback([options, command, &invocation] {
    require_input(*command, options->input, "a mesh or a scene");
    if (options->table) return print_table(*options, invocation.console);
    options->outputs.require(*command, "-o folder/");
    write_runs(*options, invocation.console);
  });
}

}  // namespace sprung
