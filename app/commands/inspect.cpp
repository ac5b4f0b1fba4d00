#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/console/crossings_json.h"
#include "app/inspect/crossings_report.h"
#include "app/inspect/inspection.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/cache.h"
#include "core/simulation/run_cache.h"
#include "core/text.h"
#include "render/image/png.h"

namespace sprung {
namespace {

struct InspectOptions {
  bool json = false;
  bool crossings = false;
  std::filesystem::path picture;  // empty: none
  bool overwrite = false;
  SceneOptions scene;
};

void inspect_scene(const InspectOptions& options, const Console& console) {
  options.scene.with_scene(console, [&](const Film& film) {
    if (!options.picture.empty()) {
      refuse_existing(options.picture, options.overwrite);
      check_writable(options.picture);
    }
    std::vector<std::string> warnings;
    Console listening = console;
    listening.warnings = &warnings;
    const Preparation prepared = prepare(film, listening);
    Inspection inspection = inspect(prepared, film);
    if (inspection.forecast.plan) {
      if (const std::string text = warning_of(*inspection.forecast.plan); !text.empty()) listening.warn(text);
    }
    if (const std::string text = warning_of_memory(inspection.forecast.memory); !text.empty()) listening.warn(text);
    inspection.warnings = std::move(warnings);
    fmt::print("{}", options.json ? inspection_json(inspection) : inspection_text(inspection));
    if (options.picture.empty()) return;
    make_folder(options.picture.parent_path());
    write_png(draw_bricks(prepared), options.picture);
    console.note(
        fmt::format("{}: orange: parts thinner than a brick; blue: bricks that share a cell; purple: closed holes; "
                    "darker: less than half full",
                    options.picture.string()));
  });
}

/// The facts that are printed about a cache.
struct CacheFacts {
  std::string version;
  std::string build;
  std::size_t frames = 0;
  int planned = 0;           // by the scene
  bool may_be_less = false;  // if the film ends once nothing moves
  double progress = 0;
  std::string progress_name;
  std::uint64_t state_hash = 0;  // of the last frame
  long solids = 0;
  long bricks = 0;
  long nodes = 0;
  long skin_vertices = 0;
  std::uintmax_t bytes = 0;
  std::string accuracy;
  double position_error = 0;  // m
  double velocity_error = 0;  // m/s
};

CacheFacts facts_of(const CacheReader& cache, const std::filesystem::path& file) {
  const CacheHeader& header = cache.header();
  const Film film = cached_film(header);
  CacheFacts facts{.version = header.version,
                   .build = header.build,
                   .frames = cache.frame_count(),
                   .planned = frame_count(film),
                   .may_be_less = film.until_still.has_value(),
                   .progress_name = header.progress_name,
                   .solids = long(header.simulation.world.bodies.size()),
                   .bytes = std::filesystem::file_size(file),
                   .accuracy = position_accuracy(header),
                   .position_error = header.position_error,
                   .velocity_error = header.velocity_error};
  if (facts.frames > 0) {
    const CachedFrame last = cache.frame(facts.frames - 1);
    facts.progress = last.progress;
    facts.state_hash = last.state_hash;
  }
  for (const SoftBody& body : header.simulation.world.bodies) {
    facts.bricks += body.grid.brick_count();
    facts.nodes += body.grid.node_count();
    facts.skin_vertices += body.drawn.skin.positions.rows();
  }
  return facts;
}

std::string text_of(const CacheFacts& facts) {
  const std::string velocities =
      facts.velocity_error > 0 ? fmt::format(", velocities to within {:.6g} m/s", facts.velocity_error) : "";
  return fmt::format(
      "frames {} of {}{}, the last at {} {:.6g}\nstate {:016x}\n{}, {}, {} nodes, {} skin vertices\npositions {}{}\n"
      "{:.4g} MB, written by sprung {} (build {})\n",
      facts.frames, facts.may_be_less ? "at most " : "", facts.planned, facts.progress_name, facts.progress,
      facts.state_hash, count_of(facts.solids, "solid"), count_of(facts.bricks, "brick"), facts.nodes,
      facts.skin_vertices, facts.accuracy, velocities, 1e-6 * double(facts.bytes), facts.version, facts.build);
}

std::string json_of(const CacheFacts& facts) {
  const nlohmann::ordered_json json{{"frames", facts.frames},
                                    {"planned_frames", facts.planned},
                                    {facts.progress_name, facts.progress},
                                    {"state_hash", fmt::format("{:016x}", facts.state_hash)},
                                    {"solids", facts.solids},
                                    {"bricks", facts.bricks},
                                    {"nodes", facts.nodes},
                                    {"skin_vertices", facts.skin_vertices},
                                    {"position_error", facts.position_error},
                                    {"velocity_error", facts.velocity_error},
                                    {"bytes", facts.bytes},
                                    {"version", facts.version},
                                    {"build", facts.build}};
  return json.dump(1) + "\n";
}

void inspect_crossings(const InspectOptions& options, const CacheReader& cache, const Console& console) {
  if (!options.picture.empty()) {
    refuse_existing(options.picture, options.overwrite);
    check_writable(options.picture);
  }
  const CrossingsReport report = find_crossings(cache, !options.picture.empty(), console);
  fmt::print("{}", options.json ? json_of(report.frames).dump(1) + "\n" : text_of(report.frames));
  if (options.picture.empty()) return;
  if (report.picture.pixels.empty()) return console.note("no skins cross: no picture");
  make_folder(options.picture.parent_path());
  write_png(report.picture, options.picture);
  console.note(
      fmt::format("{}: the frame of the deepest place (black), on the right from near; red: triangles that cross",
                  options.picture.string()));
}

void inspect_cache(const InspectOptions& options, const Console& console) {
  const bool has_scene_options = !options.scene.keys.settings().empty() || !options.scene.scenario.empty();
  if (has_scene_options || (!options.picture.empty() && !options.crossings)) {
    throw Error(ErrorKind::kUsage, "inspect of a cache takes --json, and --crossings with --picture");
  }
  const CacheReader cache(options.scene.input);
  if (options.crossings) return inspect_crossings(options, cache, console);
  if (options.scene.print_scene) {
    fmt::print("{}", cache.header().scene);
    return;
  }
  const CacheFacts facts = facts_of(cache, options.scene.input);
  fmt::print("{}", options.json ? json_of(facts) : text_of(facts));
}

}  // namespace

void add_inspect(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("inspect", "mesh, scene or cache in, its properties and the cost of its film out");
  const auto options = std::make_shared<InspectOptions>();
  command->add_flag("--json", options->json, "the facts as JSON");
  command->add_flag("--crossings", options->crossings, "of a cache: where skins cross each other, frame by frame");
  command->add_option("--picture", options->picture, "draw skin and bricks, or where skins cross the deepest")
      ->option_text("FILE.png");
  command->add_flag("--overwrite", options->overwrite, "replace a picture that exists");
  options->scene.add_to(*command, invocation, true, "a mesh file, a scene (.toml), or a cache (.h5)");
  add_messages(*command, invocation.console);
  command->footer(scene_footer(*command,
                               "Examples:\n  sprung inspect bunny.obj --bricks auto --picture bunny.png\n"
                               "  sprung inspect run.h5 --crossings --picture deepest.png\n"));
  command->callback([options, command, &invocation] {
    require_input(*command, options->scene.input, "a mesh or a scene");
    if (is_cache_file(options->scene.input)) return inspect_cache(*options, invocation.console);
    if (options->crossings)
      throw Error(ErrorKind::kUsage, "--crossings applies to a cache, RUN.h5; make one with simulate");
    inspect_scene(*options, invocation.console);
  });
}

}  // namespace sprung
