#include "app/commands/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"
#include "app/film/render_film.h"
#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/law/brick_law.h"
#include "core/simulation/run_cache.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Only how the run is seen can still be chosen.
void apply_settings(const SceneOptions& options, Film& scene) {
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

const std::string& checked(const std::string& file) {
  if (is_cache_file(file)) return file;
  throw Error(
      ErrorKind::kUsage,
      fmt::format("'{}' is no cache (.h5), as sprung simulate makes them; sprung animate draws a mesh or a scene",
                  file));
}

/// A cache and the scene by which it is drawn.
struct CachedFilm {
  CachedFilm(const std::string& file, const SceneOptions& options)
      : cache(checked(file)), scene(cached_film(cache.header())) {
    if (cache.frame_count() == 0) throw Error(ErrorKind::kBadInput, fmt::format("'{}' has no frames yet", file));
    apply_settings(options, scene);
    name = fs::path(file).stem().string();
  }

  CacheReader cache;
  Film scene;
  std::string name;
};

/// The files' names; and the law of the bricks and the material where those differ.
void name_runs(std::vector<CachedFilm>& films) {
  const auto add = [&films](auto&& word) {
    std::vector<std::string> words;
    words.reserve(films.size());
    for (const CachedFilm& film : films) words.emplace_back(word(film.scene.bodies.front()));
    if (std::adjacent_find(words.begin(), words.end(), std::not_equal_to<>()) == words.end()) return;
    for (std::size_t i = 0; i < films.size(); ++i) {
      if (!words[i].empty() && films[i].name.find(words[i]) == std::string::npos) films[i].name += ", " + words[i];
    }
  };
  add([](const SceneBody& body) { return std::string(model_name(body.model)); });
  add([](const SceneBody& body) { return body.material.name; });
}

std::vector<CachedFilm> open_all(const SceneOptions& options) {
  std::vector<CachedFilm> films;
  films.emplace_back(options.input, options);
  for (const std::string& other : options.others) films.emplace_back(other, options);
  if (films.size() > 1) name_runs(films);
  return films;
}

/// With all frames of all caches in memory.
void render_films(const std::vector<CachedFilm>& films, const std::optional<Environment>& surroundings,
                  const FrameRange& range, const std::vector<Output>& outputs, const Console& console, int jobs) {
  std::vector<Simulation> simulations;
  std::vector<Recording> recordings;
  simulations.reserve(films.size());
  recordings.reserve(films.size());
  std::vector<FilmRun> runs;
  for (const CachedFilm& film : films) {
    const Simulation& simulation = simulations.emplace_back(cached_simulation(film.cache.header(), film.scene));
    const Recording& recording = recordings.emplace_back(cached_recording(film.cache));
    runs.push_back({film.scene, simulation, recording, film.name});
  }
  render_film(runs, surroundings, range, outputs, console, jobs);
}

}  // namespace

void render_cache(const SceneOptions& options, const Console& console) {
  const std::vector<CachedFilm> films = open_all(options);
  std::size_t frames = 0;
  for (const CachedFilm& film : films) frames = std::max(frames, film.cache.frame_count());
  const FrameRange range = parse_frame_range(options.frames, frames);
  const std::vector<Output> outputs = parse_outputs(options.outputs);
  for (const Output& output : outputs) check_range_output(output, range, options.overwrite);
  const std::optional<Environment> surroundings = read_surroundings(films.front().scene.render);
  render_films(films, surroundings, range, outputs, console, options.jobs);
  for (const std::string& output : options.outputs) fmt::print("{}\n", output);
}

}  // namespace sprung
