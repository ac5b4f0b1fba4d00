#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/console/console.h"
#include "app/scene/option_defaults.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sprung {

/// One run of the program.
struct Invocation {
  Console& console;
  std::string command;  // as typed, for a shell
  OptionDefaults defaults;
  std::vector<const CLI::Option*> scene_options{};  // whose defaults have lower priority than a scene file
  const CLI::App* draws_records = nullptr;          // the command that takes its scenes from caches, without defaults
  int exit_code = 0;

  /// Returns whether the command takes the default of that option from a cache, which records the value used.
  [[nodiscard]] bool is_recorded(const CLI::App* asked, const CLI::Option* option) const {
    return asked == draws_records &&
           std::find(scene_options.begin(), scene_options.end(), option) != scene_options.end();
  }
};

/// Each adds its command with its options to the program. The command's callback keeps what was typed and does the work
/// once everything has been parsed. Throws Error(kUsage) naming the option whose value is wrong, Error, Interrupted.

/// Turns a mesh or a scene into pictures and films; the outputs' names go to stdout.
void add_animate(CLI::App& app, Invocation& invocation);

/// Simulates a mesh or a scene into a cache of its frames and the measurements of its probes: probes.csv, probes.json
/// and manifest.json in the output folder; the state hash and the last measurements go to stdout.
void add_simulate(CLI::App& app, Invocation& invocation);

/// Renders a range of a cache's frames to pictures or a film, in one or several processes; the outputs' names go to
/// stdout.
void add_render(CLI::App& app, Invocation& invocation);

/// Exports frames of a cache, or of a scene that is simulated first, as meshes; the names as typed go to stdout.
void add_export(CLI::App& app, Invocation& invocation);

/// Encodes numbered pictures, drawn by any program, as films; the films' names go to stdout. Throws Error(kBadInput)
/// naming every gap in the numbers.
void add_film(CLI::App& app, Invocation& invocation);

/// `sprung sweep SCENE --set KEY=A,B,C ... -o FOLDER`: every combination of the values as a run of its own. Writes
/// FOLDER/001/scene.toml ..., the scenes as resolved, FOLDER/runs.json, which says what differs, and FOLDER/commands,
/// one line a run for a shell, GNU parallel or a scheduler; prints that file's name. Each run leaves its cache, probes
/// and a manifest in its folder. FOLDER/run, for a shell, does them all and writes FOLDER/table.csv.
/// `sprung sweep FOLDER --table`: what was set, how long the runs took and what their probes measured last, as CSV to
/// stdout, or one of these measurements as a plot; runs that are not done are named on stderr.
void add_sweep(CLI::App& app, Invocation& invocation);

/// Prints what a mesh, a scene or a cache contains and what its film will cost.
void add_inspect(CLI::App& app, Invocation& invocation);

/// Prints how far the mesh of a part bends under loads, and whether it is strong enough. Exit code 1 if it exceeds a
/// given limit.
void add_load(CLI::App& app, Invocation& invocation);

/// Runs experiments; their checks go to stdout. Exit code 1 if a check fails.
void add_validate(CLI::App& app, Invocation& invocation);

/// Prints how two pictures differ, and draws the difference if asked to. Exit code 1 if they differ too much, as
/// pictures of different sizes always do.
void add_compare(CLI::App& app, Invocation& invocation);

/// Prints the requested materials: a table with a line each; with their sources; or JSON in SI units.
void add_materials(CLI::App& app, Invocation& invocation);

/// Prints the defaults of options that apply here, and where they come from.
void add_config(CLI::App& app, Invocation& invocation);

/// Prints help on a command, the keys of a scene, the manual or the completions.
void add_help(CLI::App& app, Invocation& invocation);

}  // namespace sprung

namespace sprung {

/// Runs the command line and returns the exit code. Throws Error(kUsage), with the nearest word for a mistyped command
/// or option, and what the commands throw.
[[nodiscard]] int run_command_line(int argc, const char* const* argv, Console& console);

}  // namespace sprung
