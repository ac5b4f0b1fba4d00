#include "app/commands/export.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/command_line.h"
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

void print_formats() {
  fmt::print("One file a frame, by a name with a number like skin_{{:04}}.obj:\n");
  for (const MeshFormat& format : mesh_formats()) {
    const std::string kept = describe(format.keeps);
    fmt::print("  {:<7} {}; keeps {}\n", format.extension, format.what, kept.empty() ? "nothing else" : kept);
  }
  fmt::print(
      "All frames in one file:\n"
      "  .glb    glTF 2 with an animation, for Blender, three.js and browsers\n"
      "  .html   a page to look at in a browser, by itself\n"
      "  .pc2    Point Cache 2, .mdd LightWave: vertices of each frame, for Blender's Mesh Cache modifier\n"
      "  .xdmf   bricks with their fields, and skins, for ParaView; the numbers are in .xdmf.h5\n"
      "Left out:\n");
  for (const UnsupportedFormat& format : unsupported_formats()) fmt::print("  {}: {}\n", format.format, format.reason);
}

/// Before any work is lost.
std::vector<ExportTarget> targets_of(const SceneOptions& options, const Film& scene, const FrameRange& range) {
  std::vector<ExportTarget> targets;
  for (const std::string& words : options.outputs) {
    targets.push_back(parse_export_target(words));
    targets.back().quantize = options.quantize;
    for (const std::filesystem::path& file : files_of(targets.back(), scene, range)) {
      if (!options.overwrite && std::filesystem::exists(file)) {
        throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", file.string()));
      }
    }
    check_writable(files_of(targets.back(), scene, range).front());
  }
  const bool has_animation = std::any_of(targets.begin(), targets.end(), [](const ExportTarget& target) {
    return target.kind == ExportTarget::Kind::kAnimation;
  });
  if (options.quantize && !has_animation) {
    throw Error(ErrorKind::kUsage, "--quantize is about an animated .glb: -o film.glb");
  }
  return targets;
}

void write_all(const SceneOptions& options, const CachedFilmView& view, const FrameRange& range,
               const std::vector<ExportTarget>& targets, const Console& console) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    make_folder(files_of(targets[i], view.film, range).front().parent_path());
    export_files(targets[i], view, range, console);
    fmt::print("{}\n", options.outputs[i]);
  }
}

void export_cache(const SceneOptions& options, const Console& console) {
  if (!options.settings.empty() || options.scenario) {
    throw Error(ErrorKind::kUsage, "a cache is moved already: options of the scene change nothing in it");
  }
  const CacheReader cache(options.input);
  const Film scene = cached_film(cache.header());
  const FrameRange range = parse_frame_range(options.frames, cache.frame_count());
  const std::vector<ExportTarget> targets = targets_of(options, scene, range);
  const Simulation simulation = cached_simulation(cache.header(), scene);
  write_all(options, {simulation, cache, scene}, range, targets, console);
}

/// A cache for as long as it takes to write what is asked for, beside that.
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
void simulate_into(const std::filesystem::path& file, Simulation& simulation, const Film& scene,
                   const Console& console) {
  make_folder(file.parent_path());
  RunCache cache(file, record_of(scene), false);
  static_cast<void>(simulate(simulation, scene, console, &cache));
  cache.close();
}

}  // namespace

void export_run(const SceneOptions& options, const Console& console) {
  if (options.list) return print_formats();
  if (is_cache_file(options.input)) return export_cache(options, console);
  with_scene(options, [&](const Film& scene) {
    const FrameRange range = parse_frame_range(options.frames, frame_count(scene));
    const std::vector<ExportTarget> targets = targets_of(options, scene, range);
    Simulation simulation = prepare_simulation(scene, console);
    warn_of_memory(simulation, scene, console);
    const PassingCache passing(files_of(targets.front(), scene, range).front());
    simulate_into(passing.file(), simulation, scene, console);
    write_all(options, {simulation, CacheReader(passing.file()), scene}, range, targets, console);
  });
}

}  // namespace sprung
