#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "app/commands/commands.h"
#include "app/commands/options.h"
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

struct RenderCacheOptions {
  std::string input;
  std::vector<std::string> others;  // side by side with it
  bool side_by_side = false;
  OutputOptions outputs;
  FrameOptions frames;
  JobOptions jobs;
  bool overwrite = false;
  bool skip_existing = false;
  SettingOptions keys;
};

/// Only camera and pictures of a finished run can be changed.
void apply_all(const std::vector<Setting>& settings, Film& film) {
  for (const Setting& setting : settings) {
    if (!setting.key.starts_with("camera.") && !setting.key.starts_with("render.")) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("{}: a cache is simulated already; only keys of [camera] and [render] can be set",
                              setting.option));
    }
    apply(setting, film);
  }
}

/// Pictures of other ranges may exist.
void check_range_output(const Output& output, const FrameChoice& choice, bool overwrite) {
  if (!output.is_numbered()) return check_output(output, overwrite || choice.skips_existing);
  for (const int frame : choice.range.frames()) {
    refuse_existing(output.picture(choice.number(frame)), overwrite || choice.skips_existing);
  }
  check_output(output, true);
}

const std::string& checked(const std::string& file) {
  if (is_cache_file(file)) return file;
  throw Error(
      ErrorKind::kUsage,
      fmt::format("'{}' is not a cache (.h5) of sprung simulate; sprung animate draws a mesh or a scene", file));
}

/// A cache and its scene with the settings of the command line.
struct CachedFilm {
  CachedFilm(const std::string& file, const std::vector<Setting>& settings)
      : cache(checked(file)), scene(cached_film(cache.header())) {
    if (cache.frame_count() == 0) throw Error(ErrorKind::kBadInput, fmt::format("'{}' has no frames yet", file));
    apply_all(settings, scene);
    name = fs::path(file).stem().string();
  }

  CacheReader cache;
  Film scene;
  std::string name;
};

/// Names the runs by their files, and by brick law and material if those differ.
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

std::vector<CachedFilm> open_all(const RenderCacheOptions& options) {
  const std::vector<Setting> settings = options.keys.settings();
  std::vector<CachedFilm> films;
  films.emplace_back(options.input, settings);
  for (const std::string& other : options.others) films.emplace_back(other, settings);
  if (films.size() > 1) name_runs(films);
  return films;
}

/// Keeps all frames of all caches in memory.
void render_films(const std::vector<CachedFilm>& films, const std::optional<Environment>& surroundings,
                  const FrameChoice& choice, const std::vector<Output>& outputs, const Console& console, int jobs) {
  std::vector<Simulation> simulations;
  std::vector<Recording> recordings;
  simulations.reserve(films.size());
  recordings.reserve(films.size());
  std::vector<FilmRun> runs;
  for (const CachedFilm& film : films) {
    const Simulation& simulation = simulations.emplace_back(cached_simulation(film.cache.header(), film.scene));
    const Recording& recording = recordings.emplace_back(cached_recording(film.cache, film.scene));
    runs.push_back({film.scene, simulation, recording, film.name});
  }
  render_film(runs, surroundings, choice, outputs, console, jobs);
}

void render_cache(const CLI::App& command, const RenderCacheOptions& options, const Console& console) {
  if (options.side_by_side == options.others.empty()) {
    throw Error(ErrorKind::kUsage, options.side_by_side
                                       ? "--side-by-side needs more than one cache"
                                       : fmt::format("more than one input; what is '{}'? Runs side by side: "
                                                     "--side-by-side",
                                                     options.others.front()));
  }
  require_input(command, options.input, "a cache (.h5)");
  options.outputs.require(command, "-o folder/, -o frame_{:04}.png, -o still.png or -o film.mp4");
  const int jobs = options.jobs.count();
  const std::vector<CachedFilm> films = open_all(options);
  std::size_t frames = 0;
  for (const CachedFilm& film : films) frames = std::max(frames, film.cache.frame_count());
  FrameChoice choice = options.frames.choice(frames, films.front().scene.fps);
  choice.skips_existing = options.skip_existing;
  const std::vector<Output> outputs = parse_outputs(options.outputs.names);
  check_outputs(films.front().scene, films.size(), choice, outputs);
  for (const Output& output : outputs) check_range_output(output, choice, options.overwrite);
  const std::optional<Environment> surroundings = read_surroundings(films.front().scene.render);
  render_films(films, surroundings, choice, outputs, console, jobs);
  for (const Output& output : outputs) {
    if (options.overwrite && options.frames.is_whole_film())
      clear_beyond(output, choice.number(choice.range.last), console);
  }
  options.outputs.print();
}

}  // namespace

void add_render(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("render", "a cache in, pictures or film out");
  const auto options = std::make_shared<RenderCacheOptions>();
  command->add_option("INPUT", options->input, "a cache (.h5)");
  command->add_option("MORE", options->others, "more caches, with --side-by-side");
  command->add_flag("--side-by-side", options->side_by_side, "several runs in one film: one camera, one scale");
  options->outputs.add_to(*command, kPicturesHelp);
  options->frames.add_to(*command);
  command->add_flag("--skip-existing", options->skip_existing, "draw only pictures that are missing");
  options->jobs.add_to(*command);
  command->add_flag("--overwrite", options->overwrite, "replace pictures and films that exist");
  options->keys.add_keys(*command, invocation, [](const KeyOption& key) { return key.key.starts_with("render."); });
  options->keys.add_set(*command, invocation, "any key of [camera] and [render]");
  invocation.draws_records = command;
  add_messages(*command, invocation.console);
  command->footer(
      "Examples:\n  sprung render run.h5 -o film.mp4\n  sprung render run.h5 -o frames/ --frames 1:48 --jobs 4\n"
      "  sprung render run.h5 -o stress.mp4 --color-by stress --set camera.orbit=90\n"
      "All options: sprung help render    All keys of a scene: sprung help scene");
  command->callback([options, command, &invocation] { render_cache(*command, *options, invocation.console); });
}

}  // namespace sprung
