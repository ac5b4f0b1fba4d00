#include "app/commands/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>

#include "app/scene/scene_reference.h"

namespace sprung {
namespace {

/// What every command that works for a while says of it.
void add_messages(CLI::App& command, RawOptions& words, const std::string& verbose = "more about every stage") {
  command.add_flag("--quiet", words.scene.quiet, "warnings and errors only");
  command.add_flag("--verbose", words.scene.verbose, verbose);
  command.add_flag("--log-json", words.log_json, "messages and progress as JSON on stderr, an object a line");
}

void add_outputs(CLI::App& command, RawOptions& words, const std::string& help,
                 const std::string& placeholder = "OUT") {
  command.add_option("-o,--output", words.scene.outputs, help)->allow_extra_args(false)->option_text(placeholder);
}

void add_sets(CLI::App& command, RawOptions& words, const std::string& help,
              const std::string& placeholder = "KEY=VALUE") {
  command.add_option("--set", words.set, help + "; may be given several times")
      ->allow_extra_args(false)
      ->option_text(placeholder);
}

void add_scene_option(CLI::App& command, RawOptions& words, std::size_t row) {
  const KeyOption& option = key_options()[row];
  CLI::Option* added = command.add_option(option.option, words.scene_values[row], help_of(option));
  added->option_text(option.example);
  if (!option.use.is_common) added->group(kMoreOptions);
}

void add_scene_options(CLI::App& command, RawOptions& words, bool has_pictures, const std::string& examples,
                       const std::string& input = "a mesh file, or a scene (.toml)") {
  command.add_option("INPUT", words.scene.input, input);
  for (std::size_t i = 0; i < words.scene_values.size(); ++i) {
    if (!key_options()[i].use.is_of_pictures || has_pictures) add_scene_option(command, words, i);
  }
  add_sets(command, words, "any key of a scene (sprung help scene)");
  command
      .add_option("--scenario", words.scenario,
                  fmt::format("what a bare mesh does: {}", fmt::join(scenario_names(), ", ")))
      ->option_text("NAME");
  command.add_option("--threads", words.threads, "threads of the simulation; default: all cores")
      ->option_text("N")
      ->group(kMoreOptions);
  command.add_flag("--print-scene", words.scene.print_scene, "write the scene as resolved to stdout, and stop");
  add_messages(command, words);
  command.footer(
      examples +
      "Lengths, times, pressures and densities take a unit (\"3 cm\", 20kPa, 1.2g/cm3); a bare number is SI.\n"
      "Options override the scene file, which overrides the defaults.\n"
      "All options: sprung help " +
      command.get_name() + "    All keys of a scene: sprung help scene");
  command.allow_extras();
}

CLI::Option* add_jobs(CLI::App& command, RawOptions& words) {
  return command.add_option("--jobs", words.jobs, "so many processes draw; default: one a core, for 24 frames each")
      ->option_text("N");
}

void add_animate(CLI::App& app, RawOptions& words) {
  CLI::App* animate = app.add_subcommand("animate", "mesh or scene in, pictures or film out");
  add_outputs(*animate, words, "folder/, folder/frame_{:04}.png, or film.mp4, .webm, .gif; may be given several times");
  animate->add_flag("--overwrite", words.scene.overwrite, "replace pictures and films that exist");
  add_jobs(*animate, words)->group(kMoreOptions);
  add_scene_options(*animate, words, true,
                    "Examples:\n  sprung animate bunny.obj -o bunny.mp4\n"
                    "  sprung animate bunny.obj -o frames/ --material rubber --size 12cm --scenario hang\n"
                    "  sprung animate scene.toml -o out/f_{:04}.png --color-by stress --set render.ghost=true\n");
}

void add_simulate(CLI::App& app, RawOptions& words) {
  CLI::App* simulate = app.add_subcommand("simulate", "mesh or scene in, its motion out: a cache, measurements");
  add_outputs(*simulate, words,
              "RUN.h5, a cache of all frames, or folder/ for probes.csv, probes.json and manifest.json; or both");
  simulate->add_flag("--overwrite", words.scene.overwrite, "replace files that exist");
  simulate->add_flag("--resume", words.scene.resume, "go on where the cache ends; begin where there is none");
  simulate
      ->add_option(
          "--position-error", words.position_error,
          "keep positions in the cache to within this, velocities to within this a frame: smaller; default: to "
          "the last bit")
      ->option_text("LENGTH");
  add_scene_options(
      *simulate, words, false,
      "Examples:\n  sprung simulate scene.toml -o run.h5\n  sprung simulate scene.toml -o run.h5 --resume\n"
      "  sprung simulate beam.toml -o out/\n");
}

void add_render(CLI::App& app, RawOptions& words) {
  CLI::App* render = app.add_subcommand("render", "a cache in, pictures or film out");
  render->add_option("INPUT", words.scene.input, "a cache (.h5)");
  render->add_option("MORE", words.scene.others, "more caches, with --side-by-side");
  render->add_flag("--side-by-side", words.scene.side_by_side, "several runs in one film: one camera, one scale");
  add_outputs(*render, words, "folder/, folder/frame_{:04}.png, or film.mp4, .webm, .gif; may be given several times");
  render->add_option("--frames", words.scene.frames, "these only, counted from 1; default: all")->option_text("A:B");
  add_jobs(*render, words);
  render->add_flag("--overwrite", words.scene.overwrite, "replace pictures and films that exist");
  for (std::size_t i = 0; i < words.scene_values.size(); ++i) {
    if (key_options()[i].key.starts_with("render.")) add_scene_option(*render, words, i);
  }
  add_sets(*render, words, "any key of [camera] and [render]");
  add_messages(*render, words);
  render->footer(
      "Examples:\n  sprung render run.h5 -o film.mp4\n  sprung render run.h5 -o frames/ --frames 1:48 --jobs 4\n"
      "  sprung render run.h5 -o stress.mp4 --color-by stress --set camera.orbit=90\n"
      "All options: sprung help render    All keys of a scene: sprung help scene");
  render->allow_extras();
}

void add_export(CLI::App& app, RawOptions& words) {
  CLI::App* command = app.add_subcommand("export", "a cache, mesh or scene in, deformed meshes out");
  add_outputs(*command, words,
              "skin_{:04}.obj or another format, film.glb, film.html, points.pc2, points.mdd, run.xdmf; may be given "
              "several times");
  command->add_option("--frames", words.scene.frames, "these only, counted from 1; default: all")->option_text("A:B");
  command->add_flag("--quantize", words.scene.quantize,
                    "keep 16 bits a coordinate in film.glb: half the size; says how far off that is");
  command->add_flag("--list", words.scene.list, "name the formats, and stop");
  command->add_flag("--overwrite", words.scene.overwrite, "replace files that exist");
  add_scene_options(
      *command, words, false,
      "Examples:\n  sprung export run.h5 -o film.glb\n  sprung export run.h5 -o skin_{:04}.obj -o points.pc2\n",
      "a cache (.h5), a mesh file, or a scene (.toml)");
}

void add_film(CLI::App& app, RawOptions& words) {
  CLI::App* film = app.add_subcommand("film", "numbered pictures in, a film out");
  film->add_option("INPUT", words.scene.input, "folder/, or folder/frame_{:04}.png");
  add_outputs(*film, words, "film.mp4, .webm, .gif; may be given several times");
  film->add_option("--frames", words.scene.frames, "these only; default: from 1 to the last that is there")
      ->option_text("A:B");
  film->add_option("--fps", words.fps, "pictures a second; default: 24")->option_text("N");
  film->add_flag("--overwrite", words.scene.overwrite, "replace films that exist");
  add_messages(*film, words);
  film->footer("Example:\n  sprung film frames/ -o film.mp4 --fps 24");
  film->allow_extras();
}

void add_sweep(CLI::App& app, RawOptions& words) {
  CLI::App* sweep = app.add_subcommand("sweep", "a scene and lists of values in, a folder and a command a run out");
  sweep->add_option("INPUT", words.scene.input, "a mesh file, a scene (.toml), or with --table the folder of a sweep");
  add_outputs(*sweep, words, "the folder for all runs", "FOLDER");
  add_sets(*sweep, words, "values of any key of a scene, by commas", "KEY=A,B,C");
  sweep->add_flag("--table", words.scene.table, "what the probes of all runs saw last, as CSV");
  sweep->add_flag("--overwrite", words.scene.overwrite, "replace the list of commands that exists");
  add_messages(*sweep, words);
  sweep->footer(
      "Examples:\n  sprung sweep scene.toml --set body.material=gelatin,rubber -o runs\n  sh runs/commands\n"
      "  sprung sweep runs --table");
  sweep->allow_extras();
}

void add_inspect(CLI::App& app, RawOptions& words) {
  CLI::App* inspect =
      app.add_subcommand("inspect", "mesh, scene or cache in, what it is and what its film will take out");
  inspect->add_flag("--json", words.scene.json, "the facts as JSON");
  inspect->add_option("--picture", words.scene.picture, "draw skin and bricks, thin parts marked")
      ->option_text("FILE.png");
  inspect->add_flag("--overwrite", words.scene.overwrite, "replace a picture that exists");
  add_scene_options(
      *inspect, words, true,
      "Examples:\n  sprung inspect bunny.obj\n  sprung inspect bunny.obj --bricks auto --picture bunny.png\n"
      "  sprung inspect run.h5 --json\n",
      "a mesh file, a scene (.toml), or a cache (.h5)");
}

void add_validate(CLI::App& app, RawOptions& words) {
  CLI::App* validate = app.add_subcommand("validate", "experiments, measured against theory and reference");
  validate->add_option("FILES", words.validate.cases, "scenes with [[expect]]; default: the built-in experiments");
  validate->add_option("--case", words.validate.cases, "a built-in experiment; may be given several times")
      ->allow_extra_args(false)
      ->option_text("NAME");
  validate->add_flag("--list", words.validate.list, "name the built-in experiments, and stop");
  validate->add_option("--model", words.model, "this law of the bricks only")->option_text("NAME");
  validate->add_option("--poisson", words.poisson, "this Poisson's ratio only")->option_text("NU");
  validate->add_option("--bricks", words.bricks, "this grid only, by the bricks along the longest side")
      ->option_text("N");
  validate->add_flag("--json", words.validate.json, "checks as JSON");
  validate->add_option("--report", words.validate.report, "folder for report.html")->option_text("DIR");
  add_messages(*validate, words, "say why a model could not be carried through");
  validate->footer(
      "Examples:\n  sprung validate\n  sprung validate --case cantilever --model calibrated\n"
      "  sprung validate mine.toml --report out/report");
  validate->allow_extras();
}

void add_compare(CLI::App& app, RawOptions& words) {
  CLI::App* compare = app.add_subcommand("compare", "two pictures: how much they differ; exit code 1 if too much");
  compare->add_option("A", words.compare.first, "a PNG")->option_text("A.png");
  compare->add_option("B", words.compare.second, "another")->option_text("B.png");
  compare->add_option("--mean", words.compare.mean, "levels of 255 that they may differ by on average; default: 0.4")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  compare->add_option("--worst-block", words.compare.worst_block, "the same in the worst 8 x 8 pixels; default: 6")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  compare->add_option("--difference", words.compare.difference, "picture of the differences, 16 times as large")
      ->option_text("FILE.png");
  compare->add_flag("--overwrite", words.compare.overwrite, "replace a picture that exists");
  compare->footer("Example:\n  sprung compare golden.png new.png --difference difference.png");
  compare->allow_extras();
}

void add_materials(CLI::App& app, RawOptions& words) {
  MaterialsOptions& asked = words.materials;
  CLI::App* materials = app.add_subcommand("materials", "what bodies can be made of, with sources and uncertainties");
  materials->add_option("WORDS", asked.words, "these only: part of a name, or a class");
  materials->add_option("--class", asked.material_class, "these only: gelatin, silicone, rubber, foam, wood, ...")
      ->option_text("NAME");
  materials->add_option("--young", asked.young, "these only: Young's modulus from A to B")->option_text("A:B");
  materials->add_option("--materials", asked.files, "a file with materials of your own; may be given several times")
      ->allow_extra_args(false)
      ->option_text("FILE.toml");
  materials->add_flag("--sources", asked.sources, "where every figure is from");
  materials->add_flag("--json", asked.json, "as JSON, SI units, with the sources");
  materials->footer(
      "Examples:\n  sprung materials\n  sprung materials silicone --young :1MPa\n  sprung materials steel --sources\n"
      "  sprung materials --materials mine.toml --json");
  materials->allow_extras();
}

void add_help(CLI::App& app, RawOptions& words) {
  CLI::App* help = app.add_subcommand("help", "on a command, or on the keys of a scene: sprung help scene");
  help->add_option("TOPIC", words.topic,
                   "a command; scene, its keys; man, the manual as roff; bash, zsh or fish, completions for it");
  help->add_flag("--json-schema", words.json_schema, "the keys of a scene as a JSON Schema");
  help->footer("Examples:\n  sprung help animate\n  sprung help scene");
  help->allow_extras();
}

}  // namespace

void add_commands(CLI::App& app, RawOptions& words) {
  add_animate(app, words);
  add_simulate(app, words);
  add_render(app, words);
  add_export(app, words);
  add_film(app, words);
  add_sweep(app, words);
  add_inspect(app, words);
  add_validate(app, words);
  add_compare(app, words);
  add_materials(app, words);
  add_help(app, words);
}

void show_all(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_group() == kMoreOptions) option->group("More options");
  }
}

namespace {

constexpr std::array<KeyOption, 22> kKeyOptions{{
    {"--material", "body.material", "NAME", {.is_common = true}},
    {"--materials", "materials", "FILE.toml"},
    {"--young", "body.material.young", "20kPa", {.is_common = true}},
    {"--poisson", "body.material.poisson", "0.45"},
    {"--density", "body.material.density", "1.1g/cm3"},
    {"--damping", "body.material.damping", "0.03"},
    {"--size", "body.size", "12cm", {.is_common = true}},
    {"--bricks", "body.bricks", "N|auto", {.is_common = true}},
    {"--brick-size", "body.brick_size", "5mm"},
    {"--repair", "body.repair", "off|auto|strict"},
    {"--thickness", "body.thickness", "3mm"},
    {"--texture", "body.texture", "FILE.png", {.is_of_pictures = true}},
    {"--model", "body.model", "NAME"},
    {"--scheme", "solver.scheme", "NAME"},
    {"--integrator", "solver.scheme", "NAME"},
    {"--time-limit", "solver.time_limit", "24h"},
    {"--fps", "fps", "N", {.is_common = true}},
    {"--duration", "duration", "3s", {.is_common = true}},
    {"--resolution", "render.resolution", "WxH", {.is_of_pictures = true, .is_common = true}},
    {"--quality", "render.quality", "preview|default|high", {.is_of_pictures = true, .is_common = true}},
    {"--samples", "render.samples", "N", {.is_of_pictures = true}},
    {"--color-by", "render.color_by", "FIELD", {.is_of_pictures = true, .is_common = true}},
}};

}  // namespace

std::span<const KeyOption> key_options() { return kKeyOptions; }

std::string help_of(const KeyOption& option) { return std::string(key_at(option.key).help); }

}  // namespace sprung
