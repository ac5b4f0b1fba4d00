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
  std::vector<const CLI::Option*> scene_options{};  // whose defaults rank below what a scene file says
  const CLI::App* draws_records = nullptr;          // the command whose scenes are those of caches, without defaults
  int exit_code = 0;

  /// Whether the command takes its defaults of that option from a cache, which records what held.
  [[nodiscard]] bool is_recorded(const CLI::App* asked, const CLI::Option* option) const {
    return asked == draws_records &&
           std::find(scene_options.begin(), scene_options.end(), option) != scene_options.end();
  }
};

/// Each adds its command with its options to the program. What was typed is kept by the command's callback, which does
/// the work once all of it has been parsed. Throws Error(kUsage) naming the option whose value is wrong, Error,
/// Interrupted.

/// From a mesh or a scene to pictures and films; the outputs' names go to stdout.
void add_animate(CLI::App& app, Invocation& invocation);

/// From a mesh or a scene to a cache of its frames and to the measurements of its probes: probes.csv, probes.json and
/// manifest.json in the output folder; the state hash and what the probes saw last go to stdout.
void add_simulate(CLI::App& app, Invocation& invocation);

/// A range of a cache's frames to pictures or a film, by one or several processes; the outputs' names go to stdout.
void add_render(CLI::App& app, Invocation& invocation);

/// Frames of a cache, or of a scene that is simulated for it, as meshes; the names as typed go to stdout.
void add_export(CLI::App& app, Invocation& invocation);

/// Numbered pictures, drawn by whatever program, to films; the films' names go to stdout. Throws Error(kBadInput)
/// naming every gap in the numbers.
void add_film(CLI::App& app, Invocation& invocation);

/// `sprung sweep SCENE --set KEY=A,B,C ... -o FOLDER`: every combination of the values as a run of its own. Writes
/// FOLDER/001/scene.toml ..., the scenes as resolved, FOLDER/runs.json, which says what differs, and FOLDER/commands,
/// one line a run for a shell, GNU parallel or a scheduler; prints that file's name. Each run leaves its cache, probes
/// and a manifest in its folder. FOLDER/run, for a shell, does them all and writes FOLDER/table.csv.
/// `sprung sweep FOLDER --table`: what was set, how long the runs took and what their probes saw last, as CSV to
/// stdout, or one of these measurements as a plot; runs that are not done are named on stderr.
void add_sweep(CLI::App& app, Invocation& invocation);

/// What a mesh, a scene or a cache is and what its film will take, to stdout.
void add_inspect(CLI::App& app, Invocation& invocation);

/// How far a mesh of a part bends under loads, and whether it holds, to stdout. Exit code 1 where it goes beyond a
/// limit that was given.
void add_load(CLI::App& app, Invocation& invocation);

/// Runs experiments; their checks go to stdout. Exit code 1 where a check fails.
void add_validate(CLI::App& app, Invocation& invocation);

/// How two pictures differ, to stdout, and as a picture where one is wanted. Exit code 1 where they differ too much, as
/// pictures of different size always do.
void add_compare(CLI::App& app, Invocation& invocation);

/// The materials that were asked for, to stdout: a table, a line each; with their sources; or JSON, SI units.
void add_materials(CLI::App& app, Invocation& invocation);

/// The defaults of options that hold here, and from where, to stdout.
void add_config(CLI::App& app, Invocation& invocation);

/// Help on a command, the keys of a scene, the manual and the completions, to stdout.
void add_help(CLI::App& app, Invocation& invocation);

}  // namespace sprung

namespace sprung {

/// Does what the words of the command line ask for and returns the exit code. Throws Error(kUsage), with the nearest
/// word for a mistyped command or option; what the commands throw.
[[nodiscard]] int run_command_line(int argc, const char* const* argv, Console& console);

}  // namespace sprung
