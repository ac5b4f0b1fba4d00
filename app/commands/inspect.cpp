#include "app/commands/inspect.h"

#include <fmt/format.h>

#include "app/commands/command_line.h"
#include "app/console/json_text.h"
#include "app/inspect/inspection.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "core/io/files.h"
#include "core/simulation/cache.h"
#include "core/simulation/run_cache.h"
#include "core/text.h"
#include "render/image/png.h"

namespace sprung {
namespace {

void check_picture(const SceneOptions& options) {
  if (options.picture.empty()) return;
  if (!options.overwrite && std::filesystem::exists(options.picture)) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", options.picture.string()));
  }
  check_writable(options.picture);
}

}  // namespace

void run_inspect(const SceneOptions& options, const Console& console) {
  if (is_cache_file(options.input)) return inspect_cache(options);
  with_scene(options, [&](const Film& scene) {
    check_picture(options);
    std::vector<std::string> warnings;
    Console listening = console;
    listening.warnings = &warnings;
    const Preparation prepared = prepare(scene, listening);
    Inspection inspection = inspect(prepared, scene);
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

namespace {

/// What one looks for in a cache.
struct CacheFacts {
  std::string version;
  std::string build;
  std::size_t frames = 0;
  int planned = 0;  // by the scene
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
  CacheFacts facts{.version = header.version,
                   .build = header.build,
                   .frames = cache.frame_count(),
                   .planned = frame_count(cached_film(header)),
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
    facts.skin_vertices += body.skin.positions.rows();
  }
  return facts;
}

std::string text_of(const CacheFacts& facts) {
  const std::string velocities =
      facts.velocity_error > 0 ? fmt::format(", velocities to within {:.6g} m/s", facts.velocity_error) : "";
  return fmt::format(
      "frames {} of {}, the last at {} {:.6g}\nstate {:016x}\n{}, {}, {} nodes, {} skin vertices\npositions {}{}\n"
      "{:.4g} MB, written by sprung {} (build {})\n",
      facts.frames, facts.planned, facts.progress_name, facts.progress, facts.state_hash,
      count_of(facts.solids, "solid"), count_of(facts.bricks, "brick"), facts.nodes, facts.skin_vertices,
      facts.accuracy, velocities, 1e-6 * double(facts.bytes), facts.version, facts.build);
}

std::string json_of(const CacheFacts& facts) {
  return fmt::format(
      "{{\"frames\": {}, \"planned_frames\": {}, \"{}\": {}, \"state_hash\": \"{:016x}\", \"solids\": {}, \"bricks\": "
      "{}, \"nodes\": {}, \"skin_vertices\": {}, \"position_error\": {}, \"velocity_error\": {}, \"bytes\": {}, "
      "\"version\": {}, \"build\": {}}}\n",
      facts.frames, facts.planned, facts.progress_name, json_text(facts.progress), facts.state_hash, facts.solids,
      facts.bricks, facts.nodes, facts.skin_vertices, json_text(facts.position_error), json_text(facts.velocity_error),
      facts.bytes, json_text(std::string_view(facts.version)), json_text(std::string_view(facts.build)));
}

}  // namespace

void inspect_cache(const SceneOptions& options) {
  if (!options.settings.empty() || options.scenario || !options.picture.empty()) {
    throw Error(ErrorKind::kUsage, "inspect of a cache takes --json only");
  }
  const CacheReader cache(options.input);
  if (options.print_scene) {
    fmt::print("{}", cache.header().scene);
    return;
  }
  const CacheFacts facts = facts_of(cache, options.input);
  fmt::print("{}", options.json ? json_of(facts) : text_of(facts));
}

}  // namespace sprung
