#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/film/concurrent_film.h"
#include "app/film/draw_diverged.h"
#include "app/film/film_output.h"
#include "app/film/film_pipeline.h"
#include "app/film/render_film.h"
#include "app/inspect/forecast.h"
#include "app/scene/cached_film.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "core/text.h"
#include "core/units.h"
#include "render/film.h"

namespace sprung {
namespace {

/// Film formats with subsampled colour need even sides.
void note_padding(const std::vector<Output>& outputs, const SceneRender& render, const Console& console) {
  const auto [width, height] = render.resolution;
  for (const Output& output : outputs) {
    if (output.kind != Output::Kind::kFilm || !is_padded(output.file, width, height)) continue;
    console.note(
        fmt::format("size: {} gets {} x {} pixels, since its format takes even sides only; the last column or "
                    "row of {} x {} is repeated",
                    output.file.string(), width + width % 2, height + height % 2, width, height));
  }
}

/// "film.NAME" beside a film or a single picture, "NAME" in a folder, or here.
std::filesystem::path beside(const Output& output, const char* name) {
  if (output.file.empty()) return output.folder / name;
  return std::filesystem::path(output.file).replace_extension(name);
}

std::filesystem::path picture_of_diverged(const Output& output) { return beside(output, "diverged.png"); }

/// The film truncated after a frame, if that does not change the frames before it.
Film up_to(Film film, int frame) {
  const int frames = frame_count(film);
  if (!is_motion(film) || frame >= frames) return film;
  if (frames > 1) film.camera.orbit *= double(frame - 1) / double(frames - 1);
  film.duration = frame / film.fps;
  return film;
}

struct AnimateOptions {
  OutputOptions outputs;
  JobOptions jobs;
  SceneOptions scene;
  FrameOptions frames;
  std::string keep_after = "30s";
  bool overwrite = false;

  /// How long a simulation must take to be kept, s. Throws Error(kUsage).
  [[nodiscard]] double patience() const {
    try {
      return parse_quantity(keep_after, Dimension::kTime);
    } catch (const Error& error) {
      throw Error(ErrorKind::kUsage, fmt::format("--keep-after: {}", error.what()));
    }
  }
};

/// The file in which a long motion is kept until its film is complete.
std::filesystem::path motion_file(const Output& output) { return beside(output, "unfinished.h5"); }

/// Whether the file holds a motion of that scene by this program, or a part of it.
bool holds_motion(const std::filesystem::path& file, const Film& film, const SceneRecord& record) {
  if (!std::filesystem::exists(file)) return false;
  try {
    const CacheReader cache(file);
    return cache.frame_count() > 0 && int(cache.frame_count()) <= frame_count(film) &&
           cache.header().build == build_of_this_program() && record.difference(cache.header().scene).empty();
  } catch (const Error&) {
    return false;
  }
}

/// Runs `work`; if it fails, reports what it leaves behind.
void with_motion_kept(const RunCache& motion, const Console& console, const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    if (motion.has_file() && motion.frame_count() > 0) {
      console.note(fmt::format("the motion so far, {}, is kept in {}; the same command resumes from it",
                               count_of(motion.frame_count(), "frame"), motion.file().string()));
    }
    throw;
  }
}

void animate(const CLI::App& command, const AnimateOptions& options, const Console& console) {
  require_input(command, options.scene.input, "a mesh or a scene");
  if (!options.scene.print_scene)
    options.outputs.require(command, "-o folder/, -o frame_{:04}.png, -o still.png or -o film.mp4");
  const int jobs = options.jobs.count();
  const double patience = options.patience();
  options.scene.with_scene(console, [&](const Film& whole) {
    FrameChoice choice = options.frames.choice(std::size_t(frame_count(whole)), whole.fps);
    const std::vector<Output> outputs = parse_outputs(options.outputs.names);
    const bool has_passes = std::any_of(outputs.begin(), outputs.end(), [](const Output& output) {
      return output.kind == Output::Kind::kPasses;
    });  // which include the motion to the next frame
    const Film scene = up_to(whole, choice.range.last + int(has_passes));
    check_outputs(scene, 1, choice, outputs);
    for (const Output& output : outputs) check_output(output, options.overwrite);
    note_padding(outputs, scene.render, console);
    const std::optional<Environment> surroundings = read_surroundings(scene.render);  // before any work is lost
    Simulation simulation = prepare_simulation(scene, console);
    warn_of_memory(simulation, scene, console);
    const std::filesystem::path file = motion_file(outputs.front());
    const SceneRecord record = record_of(scene);
    const bool goes_on = holds_motion(file, scene, record);
    if (goes_on) console.note(fmt::format("resuming from the motion in {}", file.string()));
    RunCache motion(file, record, goes_on);
    motion.wait_for(patience);
    with_motion_kept(motion, console, [&] {
      const std::unique_ptr<ConcurrentFilm> concurrent =
          goes_on ? nullptr : ConcurrentFilm::begin(scene, simulation, surroundings, choice, outputs, console, jobs);
      const FrameSender observer(console, concurrent.get());
      Recording recording = with_picture_of_diverged(simulation.world, picture_of_diverged(outputs.front()),
                                                     [&] { return simulate(simulation, scene, observer, &motion); });
      recording.frames = motion.take_frames();
      choice.range = choice.range.within(int(recording.progress.size()));
      if (!concurrent || !concurrent->finish(choice)) {
        render_film({{scene, simulation, recording}}, surroundings, choice, outputs, console, jobs);
      }
      for (const Output& output : outputs) {
        if (options.overwrite && options.frames.is_whole_film())
          clear_beyond(output, choice.number(choice.range.last), console);
      }
    });
    if (motion.has_file()) std::filesystem::remove(motion.file());
    options.outputs.print();
  });
}

}  // namespace

void add_animate(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("animate", "mesh or scene in, pictures or film out");
  const auto options = std::make_shared<AnimateOptions>();
  options->outputs.add_to(*command, kPicturesHelp);
  command->add_flag("--overwrite", options->overwrite, "replace pictures and films that exist");
  options->jobs.add_to(*command)->group(kMoreOptions);
  command->add_option("--keep-after", options->keep_after, "keep a motion that takes longer until the film is whole")
      ->option_text("30s")
      ->group(kMoreOptions);
  options->frames.add_to(*command);
  command->get_option("--frames")->group(kMoreOptions);
  options->scene.add_to(*command, invocation, true);
  add_messages(*command, invocation.console);
  command->footer(scene_footer(*command,
                               "Examples:\n  sprung animate bunny.obj -o bunny.mp4\n"
                               "  sprung animate bunny.obj -o frames/ --material rubber --size 12cm --scenario hang\n"
                               "  sprung animate scene.toml -o out/f_{:04}.png --color-by stress --set "
                               "render.ghost=true\n"));
  command->callback([options, command, &invocation] { animate(*command, *options, invocation.console); });
}

}  // namespace sprung
