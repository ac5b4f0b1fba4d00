#include "core/simulation/simulate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/console/crossings_json.h"
#include "app/console/material_json.h"
#include "app/film/draw_diverged.h"
#include "app/film/film_output.h"
#include "app/inspect/forecast.h"
#include "app/scene/cached_film.h"
#include "app/scene/probe_columns.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulation.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SimulateOptions {
  OutputOptions outputs;
  bool json = false;
  bool overwrite = false;
  bool resume = false;
  std::string position_error;
  SceneOptions scene;
};

/// Largest error of the positions in a cache, m; 0: none.
double position_error_of(const SimulateOptions& options) {
  if (options.position_error.empty()) return 0;
  try {
    const double error = parse_quantity(options.position_error, Dimension::kLength);
    if (error > 0) return error;
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--position-error: {}", error.what()));
  }
  throw Error(ErrorKind::kUsage, fmt::format("--position-error is a length above 0, not {}", options.position_error));
}

/// The destinations of the results.
struct Places {
  std::optional<fs::path> folder;  // of probes.csv, probes.json and manifest.json
  std::optional<fs::path> cache;
};

/// Throws Error unless the files can be written and replace only what they may.
Places places_of(const SimulateOptions& options) {
  Places places;
  constexpr std::array<std::string_view, 1> kCaches{".h5"};
  for (const std::string& output : options.outputs.names) {
    if (!is_cache_file(output)) check_folder_name(output, kCaches, "give a cache, RUN.h5, or a folder");
    std::optional<fs::path>& place = is_cache_file(output) ? places.cache : places.folder;
    if (place) throw Error(ErrorKind::kUsage, "simulate writes one cache and one folder: -o RUN.h5 -o folder/");
    place = output;
  }
  if (options.resume && options.overwrite) throw Error(ErrorKind::kUsage, "give --resume or --overwrite, not both");
  if (options.resume && !places.cache) throw Error(ErrorKind::kUsage, "--resume continues a cache: -o RUN.h5");
  if (!options.position_error.empty() && !places.cache) {
    throw Error(ErrorKind::kUsage, "--position-error applies to a cache: -o RUN.h5");
  }
  const bool may_exist = options.overwrite || options.resume;
  if (places.cache) {
    refuse_existing(*places.cache, may_exist, "--resume to go on with it, or --overwrite to replace it");
    check_writable(*places.cache);
  }
  if (places.folder) {
    for (const char* name : {"probes.csv", "probes.json", "manifest.json"}) {
      refuse_existing(*places.folder / name, may_exist);
    }
    check_writable(*places.folder / "probes.json");
  }
  return places;
}

fs::path picture_of_diverged(const Places& places) {
  if (places.folder) return *places.folder / "diverged.png";
  return fs::path(*places.cache).replace_extension("diverged.png");
}

/// The command that resumes the run.
std::string resuming_command(const SimulateOptions& options, std::string command) {
  if (options.resume) return command;
  const std::string_view overwrite = " --overwrite";
  if (const auto place = command.find(overwrite); place != std::string::npos) command.erase(place, overwrite.size());
  return command + " --resume";
}

/// Runs `work`; if it fails, says how to resume from the cache.
Recording with_advice(const RunCache* cache, const std::string& advice, const Console& console,
                      const std::function<Recording()>& work) {
  try {
    return work();
  } catch (...) {
    if (cache != nullptr && cache->frame_count() > 0) {
      console.note(fmt::format("{} in {}; go on with: {}", count_of(cache->frame_count(), "frame is", "frames are"),
                               cache->file().string(), advice));
    }
    throw;
  }
}

void print_summary(const Recording& recording) {
  fmt::print("state {:016x}\n", recording.state_hash);
  for (int i = 0; i < recording.frequencies.size(); ++i) {
    fmt::print("frequency {} {:.6g} Hz\n", i + 1, recording.frequencies[i]);
  }
  for (const ProbeTrack& track : recording.probes) {
    const ProbeSample& last = track.samples.back();
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      if (!quantity.is_of(track.kind)) continue;
      const std::string numbers = fmt::format("{:.6g}", fmt::join(quantity.of(last), ", "));
      const bool is_one = quantity.size() == 1;
      fmt::print("{} {} {}{}\n", track.name, quantity.name, is_one ? numbers : "[" + numbers + "]",
                 quantity.unit.empty() ? "" : fmt::format(" {}", quantity.unit));
    }
  }
}

/// One line per frame under a line of names: "time_s,tip.position.x_m,...,end.torque.z_Nm".
std::string probes_csv(const Recording& recording) {
  std::string text = recording.progress_name;
  for (const ProbeTrack& track : recording.probes) {
    each_column(track.kind, [&](const ProbeQuantity& quantity, std::size_t number) {
      text += fmt::format(",{}.{}", track.name, column_name(quantity.label(number), quantity.unit));
    });
  }
  text += "\n";
  for (std::size_t frame = 0; frame < recording.progress.size(); ++frame) {
    text += fmt::format("{}", recording.progress[frame]);
    for (const ProbeTrack& track : recording.probes) {
      each_column(track.kind, [&](const ProbeQuantity& quantity, std::size_t number) {
        text += fmt::format(",{}", quantity.of(track.samples[frame])[number]);
      });
    }
    text += "\n";
  }
  return text;
}

/// The same organised by probe, with the frequencies of modes and the state hash.
Json probes_json(const Recording& recording) {
  Json tracks = Json::array();
  for (const ProbeTrack& track : recording.probes) {
    Json& json = tracks.emplace_back(Json{{"name", track.name}});
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      if (!quantity.is_of(track.kind)) continue;
      Json& values = json[column_name(quantity.name, quantity.unit)] = Json::array();
      for (const ProbeSample& sample : track.samples) {
        const std::span<const double> numbers = quantity.of(sample);
        values.push_back(numbers.size() == 1 ? Json(numbers[0]) : Json(std::vector(numbers.begin(), numbers.end())));
      }
    }
  }
  return {{"state_hash", fmt::format("{:016x}", recording.state_hash)},
          {recording.progress_name, recording.progress},
          {"frequencies_Hz", std::vector<double>(recording.frequencies.begin(), recording.frequencies.end())},
          {"probes", tracks}};
}

/// The bodies of a scene as resolved: of which material, and how large where that is given (m).
Json bodies_json(const Film& film) {
  Json bodies = Json::array();
  for (const SceneBody& body : film.bodies) {
    bodies.push_back({{"mesh", body.mesh.empty() ? Json() : Json(body.mesh.filename().string())},
                      {"size_m", body.size ? Json(*body.size) : Json()},
                      {"material", json_of(body.material)}});
  }
  return bodies;
}

/// In how many steps the guard against crossings acted, by its means.
Json json_of(const GuardCounts& counts) {
  return {{"steps", counts.steps},
          {"with_impulses", counts.impulses},
          {"with_slowed_nodes", counts.slowed},
          {"with_nodes_moving_as_one", counts.welded},
          {"failed", counts.failed}};
}

/// How a run came about: version and build of the program, the scene as resolved, a hash of each mesh file it names and
/// of the state in the last frame, and how long each frame took (s, wall clock; including those of an earlier run that
/// this one resumed).
std::string manifest_json(const Film& film, const Recording& recording) {
  Json hashes = Json::object();
  std::set<std::string> files;
  for (const SceneBody& body : film.bodies) files.insert(body.mesh.string());
  for (const SceneObstacle& obstacle : film.obstacles) files.insert(obstacle.mesh.string());
  files.erase("");
  for (const std::string& file : files) hashes[file] = file_hash(file);
  Json seconds = Json::array();
  for (const double of_frame : recording.seconds) seconds.push_back(std::round(1e4 * of_frame) / 1e4);
  const double total = std::accumulate(recording.seconds.begin(), recording.seconds.end(), 0.0);
  const Json json{{"version", SPRUNG_VERSION},
                  {"build", build_of_this_program()},
                  {"scene", print_scene(with_defaults(film))},
                  {"mesh_hashes", hashes},
                  {"frames", recording.progress.size()},
                  {"state_hash", fmt::format("{:016x}", recording.state_hash)},
                  {"crossings", json_of(recording.crossings)},
                  {"seconds", std::round(1e3 * total) / 1e3},
                  {"seconds_of_frames", seconds}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void run_simulation(const CLI::App& command, const SimulateOptions& options, const Invocation& invocation) {
  const Console& console = invocation.console;
  require_input(command, options.scene.input, "a mesh or a scene");
  if (!options.scene.print_scene) options.outputs.require(command, "-o RUN.h5 or -o folder/");
  const double position_error = position_error_of(options);
  options.scene.with_scene(console, [&](const Film& film) {
    const Places places = places_of(options);
    std::optional<RunCache> cache;
    if (places.cache) {
      make_folder(places.cache->parent_path());
      cache.emplace(*places.cache, record_of(film), options.resume, position_error);
    }
    Simulation simulation = prepare_simulation(film, console);
    warn_of_memory(simulation, film, console);
    RunCache* kept = cache ? &*cache : nullptr;
    const Recording recording = with_advice(kept, resuming_command(options, invocation.command), console, [&] {
      return with_picture_of_diverged(simulation.world, picture_of_diverged(places),
                                      [&] { return simulate(simulation, film, console, kept); });
    });
    if (cache) cache->close();
    if (places.folder) {
      make_folder(*places.folder);
      write_file(*places.folder / "probes.csv", probes_csv(recording));
      write_file(*places.folder / "probes.json", probes_json(recording).dump() + "\n");
      write_file(*places.folder / "manifest.json", manifest_json(film, recording));
    }
    if (!options.json) return print_summary(recording);
    Json json = probes_json(recording);
    json["bodies"] = bodies_json(with_defaults(film));
    json["crossings"] = json_of(recording.crossings);
    if (is_motion(film)) json["inverted_bricks"] = recording.inverted_bricks;
    if (recording.guard.steps > 0) {
      json["brick_steps"] = recording.brick_steps;
      json["guard"] = json_of(recording.guard);
    }
    fmt::print("{}\n", json.dump(1, ' ', false, Json::error_handler_t::replace));
  });
}

}  // namespace

void add_simulate(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("simulate", "mesh or scene in, its motion out: a cache, measurements");
  const auto options = std::make_shared<SimulateOptions>();
  options->outputs.add_to(
      *command, "RUN.h5, a cache of all frames, or folder/ for probes.csv, probes.json and manifest.json; or both");
  command->add_flag("--json", options->json, "probes, and where skins cross, in every frame as JSON");
  command->add_flag("--overwrite", options->overwrite, "replace files that exist");
  command->add_flag("--resume", options->resume, "go on where the cache ends; begin where there is none");
  command
      ->add_option("--position-error", options->position_error,
                   "make the cache smaller: positions accurate to this, velocities to this per frame; default: to the "
                   "last bit")
      ->option_text("LENGTH");
  options->scene.add_to(*command, invocation, false);
  add_messages(*command, invocation.console);
  command->footer(scene_footer(
      *command,
      "Examples:\n  sprung simulate scene.toml -o run.h5\n  sprung simulate scene.toml -o run.h5 --resume\n"
      "  sprung simulate beam.toml -o out/\n"));
  command->callback([options, command, &invocation] { run_simulation(*command, *options, invocation); });
}

}  // namespace sprung
