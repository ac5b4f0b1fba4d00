#include "app/commands/sweep.h"

#include <fmt/format.h>

#include "app/console/json_text.h"
#include "app/scene/cached_film.h"
#include "app/scene/make_scene.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// One combination of the values.
using Choice = std::vector<Setting>;

std::vector<Choice> choices_of(const std::vector<Setting>& settings) {
  std::vector<Choice> choices{{}};
  for (const Setting& setting : settings) {
    std::vector<Choice> longer;
    for (const Choice& choice : choices) {
      for (const std::string& value : values_in(setting.value)) {
        longer.push_back(choice);
        longer.back().push_back({setting.option, setting.key, value});
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

/// The same for every run of a sweep, so that they sort.
std::string name_of_run(std::size_t run) { return fmt::format("{:03}", run + 1); }

std::string quoted(const fs::path& path) {
  std::string text = "'";
  for (const char letter : path.string()) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

std::string json_of(const Choice& choice, const std::string& name) {
  std::string fields;
  for (const Setting& setting : choice) {
    fields += fmt::format("{}{}: {}", fields.empty() ? "" : ", ", json_text(std::string_view(setting.key)),
                          json_text(std::string_view(setting.value)));
  }
  return fmt::format("  {{\"folder\": \"{}\", \"set\": {{{}}}}}", name, fields);
}

void write_runs(const SceneOptions& options, const Console& console) {
  if (options.outputs.size() != 1) throw Error(ErrorKind::kUsage, "sweep writes into one folder: -o FOLDER");
  const fs::path folder = fs::absolute(options.outputs.front()).lexically_normal();
  if (!options.overwrite && fs::exists(folder / "commands")) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' exists; say --overwrite to replace it", (folder / "commands").string()));
  }
  const std::vector<Choice> choices = choices_of(options.settings);
  std::vector<std::string> scenes;
  for (const Choice& choice : choices) {
    SceneOptions one = options;
    one.settings = choice;
    scenes.push_back(print_scene(with_defaults(make_scene(one))));
  }
  std::string commands;
  std::string runs;
  for (std::size_t run = 0; run < choices.size(); ++run) {
    const fs::path place = folder / name_of_run(run);
    make_folder(place);
    write_file(place / "scene.toml", scenes[run]);
    commands += fmt::format("sprung simulate {} -o {} -o {} --resume\n", quoted(place / "scene.toml"),
                            quoted(place / "run.h5"), quoted(place / ""));
    runs += (run == 0 ? "" : ",\n") + json_of(choices[run], name_of_run(run));
  }
  write_file(folder / "runs.json", fmt::format("[\n{}\n]\n", runs));
  write_file(folder / "commands", commands);
  write_file(folder / "run",
                   fmt::format("# All runs one after the other, then their table.\nsh {}\n"
                               "sprung sweep {} --table | tee {}\n",
                               quoted(folder / "commands"), quoted(folder), quoted(folder / "table.csv")));
  console.note(count_of(choices.size(), "run"));
  fmt::print("{}\n", (fs::path(options.outputs.front()) / "commands").string());
}

void print_header(const CacheHeader& header) {
  fmt::print("run,frames,seconds,{},state_hash", header.progress_name);
  for (const std::string& probe : header.probes) {
    for (const char* quantity : {"position", "displacement", "force", "torque"}) {
      for (const char axis : {'x', 'y', 'z'}) fmt::print(",{}.{}.{}", probe, quantity, axis);
    }
  }
  fmt::print("\n");
}

void print_row(const std::string& run, const CacheReader& cache) {
  const CachedFrame last = cache.frame(cache.frame_count() - 1);
  double seconds = 0;
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) seconds += cache.frame(frame).seconds;
  fmt::print("{},{},{:.3f},{},{:016x}", run, cache.frame_count(), seconds, last.progress, last.state_hash);
  for (const double number : last.probes) fmt::print(",{}", number);
  fmt::print("\n");
}

void print_table(const SceneOptions& options, const Console& console) {
  const fs::path folder = options.input;
  if (!fs::exists(folder / "runs.json")) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' is no folder of a sweep: it has no runs.json", options.input));
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
    const int planned = frame_count(cached_film(cache.header()));
    if (int(cache.frame_count()) < planned) {
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

void sweep(const SceneOptions& options, const Console& console) {
  if (options.table) return print_table(options, console);
  write_runs(options, console);
}

}  // namespace sprung
