#include "app/cache/render_cache.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cache/cache_header.h"
#include "app/cache/cached_run.h"
#include "app/cache/jobs.h"
#include "app/output.h"
#include "app/render_film.h"
#include "app/scene/scene_file.h"
#include "core/error.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Only how the run is seen can still be chosen.
void apply_settings(const SceneOptions& options, Scene& scene) {
  for (const Setting& setting : options.settings) {
    if (!setting.key.starts_with("camera.") && !setting.key.starts_with("render.")) {
      throw Error(
          ErrorKind::kUsage,
          fmt::format("{}: a cache is moved already; only keys of [camera] and [render] can be set", setting.option));
    }
    try {
      set_scene_key(scene, setting.key, setting.value);
    } catch (const Error& error) {
      throw Error(ErrorKind::kUsage, fmt::format("{}: {}", setting.option, error.what()));
    }
  }
}

/// Pictures of other ranges may be there.
void check_range_output(const Output& output, const FrameRange& range, bool overwrite) {
  if (output.kind == Output::Kind::kFilm) return check_output(output, overwrite);
  for (int number = range.first; number <= range.last && !overwrite; ++number) {
    if (!fs::exists(output.picture(number))) continue;
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' exists; say --overwrite to replace it", output.picture(number).string()));
  }
  check_output(output, true);
}

}  // namespace

void render_cache(const SceneOptions& options, const Console& console) {
  const CacheReader cache(options.input);
  if (cache.frame_count() == 0) throw Error(ErrorKind::kBadInput, fmt::format("'{}' has no frames yet", options.input));
  Scene scene = cached_scene(cache.header());
  apply_settings(options, scene);
  const FrameRange range = parse_frame_range(options.frames, cache.frame_count());
  const std::vector<Output> outputs = parse_outputs(options.outputs);
  for (const Output& output : outputs) check_range_output(output, range, options.overwrite);
  const bool has_film = std::any_of(outputs.begin(), outputs.end(),
                                    [](const Output& output) { return output.kind == Output::Kind::kFilm; });
  if (has_film && options.jobs > 1) {
    throw Error(ErrorKind::kUsage, "--jobs: a film is written by one process; draw pictures, then sprung film");
  }
  run_jobs(range, options.jobs, console, [&](const FrameRange& part, const Console& own_console) {
    const Recording recording = cached_recording(cache);
    render_film(cached_production(cache.header(), scene), recording, scene, part, outputs, own_console);
  });
  for (const std::string& output : options.outputs) fmt::print("{}\n", output);
}

}  // namespace sprung
