#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/export/export_files.h"
#include "app/inspect/forecast.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/mesh_export.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

struct ExportOptions {
  OutputOptions outputs;
  std::vector<std::string> takes;  // caches in addition to the input
  std::string frames;              // "1:48:2"
  bool quantize = false;
  bool list = false;
  bool overwrite = false;
  SceneOptions scene;
};

void print_formats() {
  fmt::print("One file a frame, by a name with a number like skin_{{:04}}.obj:\n");
  for (const MeshFormat& format : mesh_formats()) {
    const std::string kept = describe(format.keeps);
    fmt::print("  {:<7} {}; keeps {}\n", format.extension, format.what, kept.empty() ? "nothing else" : kept);
  }
  fmt::print("All frames in one file:\n");
  for (const AnimationFormat& format : animation_formats()) fmt::print("  {:<7} {}\n", format.extension, format.what);
  fmt::print("Left out:\n");
  for (const UnsupportedFormat& format : unsupported_formats()) fmt::print("  {}: {}\n", format.format, format.reason);
}

/// Checked before any work is done.
std::vector<ExportTarget> targets_of(const ExportOptions& options, const Film& film, const FrameRange& range) {
  std::vector<ExportTarget> targets;
  for (const std::string& words : options.outputs.names) {
    targets.push_back(parse_export_target(words));
    targets.back().quantize = options.quantize;
    for (const std::filesystem::path& file : files_of(targets.back(), film, range)) {
      refuse_existing(file, options.overwrite);
    }
    check_writable(files_of(targets.back(), film, range).front());
  }
  const bool can_quantize = std::any_of(targets.begin(), targets.end(), [](const ExportTarget& target) {
    return target.animation != nullptr && target.animation->can_quantize;
  });
  if (options.quantize && !can_quantize) {
    throw Error(ErrorKind::kUsage, "--quantize applies to an animated .glb: -o film.glb");
  }
  for (std::size_t i = 0; i < targets.size() && !options.takes.empty(); ++i) {
    if (targets[i].animation != nullptr && targets[i].animation->holds_takes) continue;
    throw Error(ErrorKind::kUsage, fmt::format("{} holds one film; several caches become the takes of a page: -o "
                                               "film.html",
                                               options.outputs.names[i]));
  }
  return targets;
}

void write_all(const ExportOptions& options, std::span<const CachedFilmView> takes, const FrameRange& range,
               const std::vector<ExportTarget>& targets, const Console& console) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    make_folder(files_of(targets[i], takes.front().film, range).front().parent_path());
    export_files(targets[i], takes, range, console);
    fmt::print("{}\n", options.outputs.names[i]);
  }
}

/// A cache with all that a view of it needs.
struct OpenCache {
  explicit OpenCache(const std::filesystem::path& file)
      : name(file.stem().string()),
        cache(file),
        film(cached_film(cache.header())),
        simulation(cached_simulation(cache.header(), film)) {}
  [[nodiscard]] CachedFilmView view() const { return {simulation, cache, film, name}; }

  std::string name;
  CacheReader cache;
  Film film;
  Simulation simulation;
};

void export_caches(const ExportOptions& options, const Console& console) {
  if (!options.scene.keys.settings().empty() || !options.scene.scenario.empty()) {
    throw Error(ErrorKind::kUsage, "a cache is simulated already; options of the scene have no effect on it");
  }
  std::deque<OpenCache> caches;
  caches.emplace_back(options.scene.input);
  for (const std::string& take : options.takes) caches.emplace_back(take);
  std::vector<CachedFilmView> views;
  std::size_t frames = 0;
  for (const OpenCache& cache : caches) {
    views.push_back(cache.view());
    frames = std::max(frames, cache.cache.frame_count());
  }
  const FrameRange range = parse_frame_range(options.frames, frames);
  write_all(options, views, range, targets_of(options, caches.front().film, range), console);
}

/// A temporary cache beside the output.
class PassingCache {
 public:
  explicit PassingCache(const std::filesystem::path& output) : file_(output) { file_ += ".passing.h5"; }
  ~PassingCache() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  PassingCache(const PassingCache&) = delete;
  PassingCache& operator=(const PassingCache&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

/// The frames of a scene, into a cache.
void simulate_into(const std::filesystem::path& file, Simulation& simulation, const Film& film,
                   const Console& console) {
  make_folder(file.parent_path());
  RunCache cache(file, record_of(film), false);
  static_cast<void>(simulate(simulation, film, console, &cache));
  cache.close();
}

void export_run(const CLI::App& command, const ExportOptions& options, const Console& console) {
  if (options.list) return print_formats();
  require_input(command, options.scene.input, "a mesh or a scene");
  if (!options.scene.print_scene) {
    options.outputs.require(command, "-o skin_{:04}.obj, -o film.glb, ...; see sprung export --list");
  }
  if (is_cache_file(options.scene.input)) return export_caches(options, console);
  if (!options.takes.empty()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: takes of one page are caches (.h5), all of them", options.takes[0]));
  }
  options.scene.with_scene(console, [&](const Film& film) {
    const FrameRange range = parse_frame_range(options.frames, frame_count(film));
    const std::vector<ExportTarget> targets = targets_of(options, film, range);
    Simulation simulation = prepare_simulation(film, console);
    warn_of_memory(simulation, film, console);
    const PassingCache passing(files_of(targets.front(), film, range).front());
    simulate_into(passing.file(), simulation, film, console);
    const CacheReader cache(passing.file());
    const CachedFilmView view{simulation, cache, film, std::filesystem::path(options.scene.input).stem().string()};
    write_all(options, {&view, 1}, range, targets, console);
  });
}

}  // namespace

void add_export(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("export", "a cache, mesh or scene in, deformed meshes out");
  const auto options = std::make_shared<ExportOptions>();
  options->outputs.add_to(*command, example_targets() + "; may be given several times");
  command->add_option("--frames", options->frames, "these only, counted from 1; default: all")->option_text("A:B:STEP");
  command->add_flag("--quantize", options->quantize,
                    "keep 16 bits per coordinate in film.glb: half the size; reports the error");
  command->add_flag("--list", options->list, "name the formats, and stop");
  command->add_flag("--overwrite", options->overwrite, "replace files that exist");
  options->scene.add_to(*command, invocation, false, "a cache (.h5), a mesh file, or a scene (.toml)");
  command->add_option("TAKES", options->takes, "further caches: takes of one film.html");
  add_messages(*command, invocation.console);
  command->footer(scene_footer(*command,
                               "Examples:\n  sprung export run.h5 -o film.glb\n"
                               "  sprung export run.h5 -o skin_{:04}.obj -o points.pc2\n"
                               "  sprung export soft.h5 stiff.h5 -o film.html\n"));
  command->callback([options, command, &invocation] { export_run(*command, *options, invocation.console); });
}

}  // namespace sprung
