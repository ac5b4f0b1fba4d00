#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/film/film_output.h"
#include "app/load/load_answer_text.h"
#include "app/load/load_page.h"
#include "app/load/load_picture.h"
#include "app/load/part_study.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/xdmf.h"
#include "core/text.h"
#include "core/units.h"
#include "render/image/png.h"

namespace sprung {
namespace {

/// The options as typed.
struct LoadOptions {
  std::string input;
  std::vector<Setting> defaults;
  std::vector<std::string> fixes;
  std::vector<std::string> loads;
  std::vector<std::string> points;
  std::string unit;
  std::string up;
  std::string analysis = "auto";
  std::string deflection_limit;
  std::string safety;
  SettingOptions keys;
  std::filesystem::path folder;  // empty: none
  std::string modes;
  bool buckling = false;
  bool turntable = false;
  bool overwrite = false;
  bool json = false;
  bool csv = false;
};

bool is_of_part(const KeyOption& key) {
  constexpr std::array<std::string_view, 11> kKeys{"--material", "--materials", "--young",  "--poisson",
                                                   "--density",  "--size",      "--bricks", "--brick-size",
                                                   "--repair",   "--thickness", "--model"};
  return std::find(kKeys.begin(), kKeys.end(), key.option) != kKeys.end();
}

/// The part that the options describe; by default of kUsualPartMaterial.
Film scene_of(const LoadOptions& options, const Console& console) {
  SceneRequest request{.input = options.input, .settings = options.keys.settings(), .defaults = options.defaults};
  const bool has_material = std::any_of(request.settings.begin(), request.settings.end(), [](const Setting& setting) {
    return setting.key.starts_with("body.material");
  });
  const bool is_named = std::any_of(request.settings.begin(), request.settings.end(),
                                    [](const Setting& setting) { return setting.key == "body.material"; });
  if (!is_named) request.settings.insert(request.settings.begin(), {"", "body.material", kUsualPartMaterial});
  if (!has_material) console.note(fmt::format("material: {}; --material NAME for another", kUsualPartMaterial));
  Film scene = make_part_scene(request);
  if (scene.bodies[0].material.name == kAutoMaterial) {
    throw Error(ErrorKind::kUsage, "--material auto is for animations; name the material of the part");
  }
  return scene;
}

PartQuestion question_of(const LoadOptions& options, const SceneBody& body) {
  PartQuestion question{.body = body,
                        .unit = options.unit,
                        .is_z_up = options.up == "z" || (options.up != "y" && usual_up(options.input) == UpAxis::kZ),
                        .fixes = options.fixes,
                        .loads = options.loads,
                        .modes = count_in("--modes", options.modes),
                        .buckling = options.buckling};
  for (const std::string& text : options.points) question.points.push_back(point_from("--at", text));
  if (options.analysis == "linear") question.analysis = PartAnalysis::kLinear;
  if (options.analysis == "nonlinear") question.analysis = PartAnalysis::kNonlinear;
  return question;
}

/// A positive value of an option; none if it is not given. Throws Error(kUsage).
std::optional<double> limit_from(const char* option, const std::string& text, Dimension dimension) {
  if (text.empty()) return std::nullopt;
  try {
    const double value = parse_quantity(text, dimension);
    if (value > 0) return value;
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", option, error.what()));
  }
  throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' has to be above 0", option, text));
}

constexpr int kTurntableFrames = 96;
constexpr double kTurntableRate = 24;  // frames/s

/// The files written to the folder.
struct LoadFiles {
  std::filesystem::path folder;
  bool turntable;

  [[nodiscard]] std::vector<std::filesystem::path> all() const {
    std::vector<std::filesystem::path> files{folder / "load.png",  folder / "load.json", folder / "load.csv",
                                             folder / "load.html", folder / "load.xdmf", folder / "load.xdmf.h5"};
    if (turntable) files.push_back(folder / "load.mp4");
    return files;
  }
};

LoadFiles files_of(const LoadOptions& options) {
  LoadFiles files{options.folder, options.turntable};
  if (files.folder.empty()) {
    if (options.turntable) throw Error(ErrorKind::kUsage, "--turntable goes to a folder: -o folder/");
    return files;
  }
  if (options.folder.has_extension() && !std::filesystem::is_directory(options.folder)) {
    throw Error(ErrorKind::kUsage, fmt::format("-o {}: give a folder; load.png, load.html and the others go there",
                                               options.folder.string()));
  }
  for (const std::filesystem::path& file : files.all()) refuse_existing(file, options.overwrite);
  check_writable(files.all().front());
  return files;
}

void write_turntable(LoadPicture& picture, const std::filesystem::path& file, const Console& console) {
  Progress progress(console, "turntable", kTurntableFrames);
  std::optional<PictureWriter> writer;
  for (int frame = 0; frame < kTurntableFrames; ++frame) {
    console.check_interrupt();
    Image image = picture.draw_turned(360.0 * frame / kTurntableFrames);
    if (!writer) {
      writer.emplace(std::vector{parse_output(file.string())},
                     FilmWriter::Format{.width = image.width, .height = image.height, .fps = kTurntableRate});
    }
    writer->write({.image = std::move(image)});
    progress.update(frame + 1);
  }
  writer->close();
  progress.finish(fmt::format("{} pictures", kTurntableFrames));
}

/// The rest shape and the loaded one, for ParaView.
void write_xdmf(const PartSolution& solution, const std::filesystem::path& file) {
  const World& world = solution.simulation.world;
  XdmfWriter writer(file, world, regions_of(solution.simulation.origins), strain_measure(solution.scene));
  std::vector<Points> rest;
  std::vector<Points> loaded;
  std::vector<Points> velocities;
  for (const SoftBody& body : world.bodies) {
    rest.push_back(body.rest_positions);
    loaded.push_back(body.positions);
    velocities.push_back(Points::Zero(body.node_count(), 3));
  }
  writer.add_frame(0, rest, velocities);
  writer.add_frame(1, loaded, velocities);
  writer.close();
}

void write_files(const LoadFiles& files, const PartReport& report, const std::vector<PartSolution>& solutions,
                 const Console& console) {
  const PartSolution& solution = solutions.front();
  make_folder(files.folder);
  write_file(files.folder / "load.json", json_of(report));
  write_file(files.folder / "load.csv", csv_of(report));
  LoadPicture picture(report, solution);
  const Image image = picture.draw();
  write_png(image, files.folder / "load.png");
  write_file(files.folder / "load.html", load_page(report, solutions.back(), image, picture.magnification()));
  write_xdmf(solution, files.folder / "load.xdmf");
  if (files.turntable) write_turntable(picture, files.folder / "load.mp4", console);
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files.all()) names.push_back(file.filename().string());
  console.note(fmt::format("{}: {}", files.folder.string(), fmt::join(names, ", ")));
}

void load_part(const CLI::App& command, const LoadOptions& options, Invocation& invocation) {
  const Console& console = invocation.console;
  require_input(command, options.input, "a mesh");
  const PartLimits limits{
      .displacement = limit_from("--deflection-limit", options.deflection_limit, Dimension::kLength),
      .safety = limit_from("--safety", options.safety, Dimension::kNone)};
  const LoadFiles files = files_of(options);
  const Film scene = scene_of(options, console);
  const PartStudy study = study_part(question_of(options, scene.bodies[0]), console);
  const LibraryMaterial* known = scene.library->find_if_known(study.part.body.material.name);
  const PartVerdict verdict = judge(study.answer, known, limits);
  const PartReport report{study.part, study.loads, study.answer, known, verdict, limits};
  fmt::print("{}", options.json ? json_of(report) : options.csv ? csv_of(report) : text_of(report));
  if (!files.folder.empty()) write_files(files, report, study.solutions, console);
  if (!verdict.holds) invocation.exit_code = 1;
}

}  // namespace

void add_load(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("load", "mesh of a part in, its bending and its safety under loads out");
  const auto options = std::make_shared<LoadOptions>();
  command->add_option("INPUT", options->input, "a mesh file");
  command->add_option("--fix", options->fixes, "hold WHERE; WHERE:xz along these axes, WHERE:slide across it only")
      ->allow_extra_args(false)
      ->option_text("WHERE");
  command
      ->add_option("--load", options->loads,
                   "WHERE:50N (inward), WHERE:50N:-z, WHERE:2MPa, WHERE:3kg, WHERE:1.5Nm:+x (torque about x), "
                   "WHERE:1mm:-y (moved by), weight, acceleration:20m/s2:-y")
      ->allow_extra_args(false)
      ->option_text("LOAD");
  options->keys.add_keys(*command, invocation, is_of_part);
  options->defaults = default_settings(invocation.defaults, command->get_name(), is_of_part);
  command->add_option("--unit", options->unit, "unit of the file: mm, cm, m, in; default: the file's own, else mm")
      ->option_text("UNIT");
  command->add_option("--up", options->up, "vertical axis, against which weights act: y, z or auto (z for STL, 3MF)")
      ->check(CLI::IsMember({"y", "z", "auto"}))
      ->option_text("AXIS")
      ->group(kMoreOptions);
  command
      ->add_option("--analysis", options->analysis,
                   "linear (small displacements), nonlinear, or auto: linear unless it moves by 10 % of its length")
      ->check(CLI::IsMember({"auto", "linear", "nonlinear"}))
      ->option_text("auto")
      ->group(kMoreOptions);
  command
      ->add_option("--deflection-limit", options->deflection_limit,
                   "exit with 1 if the largest displacement exceeds it")
      ->option_text("0.5mm");
  command->add_option("--safety", options->safety, "exit with 1 if the safety factor is lower")->option_text("2");
  command->add_option("--at", options->points, "also displacement and stress at this point of the file")
      ->allow_extra_args(false)
      ->option_text("X,Y,Z");
  command->add_option("--modes", options->modes, "also this many of the lowest natural frequencies")->option_text("3");
  command->add_flag("--buckling", options->buckling, "also the load factor at which it buckles");
  command->add_option("-o,--output", options->folder, "a folder for load.png, .html, .json, .csv and .xdmf (ParaView)")
      ->option_text("folder/");
  command->add_flag("--turntable", options->turntable, "also load.mp4, in which the picture turns once");
  command->add_flag("--overwrite", options->overwrite, "replace files that exist")->group(kMoreOptions);
  command->add_flag("--json", options->json, "the answers as JSON: SI units, places as in the file");
  command->add_flag("--csv", options->csv, "the answers as CSV, SI units")->group(kMoreOptions);
  add_messages(*command, invocation.console);
  command->footer(
      "WHERE: x-low ... z-high, sides of the bounding box in the axes of the file; face=X,Y,Z, the face at a point; "
      "box=X,Y,Z,X,Y,Z, ball=X,Y,Z,R, the surface in there (units of the file); #rrggbb, painted so; or a part or "
      "material of the mesh by name. --fix and --load may be given several times.\n"
      "Examples:\n"
      "  sprung load bracket.stl --material abs --fix x-low --load y-high:50N:-y\n"
      "  sprung load plate.stl --material steel --fix x-low --load x-high:2kN:out --safety 2 -o out/\n"
      "All options: sprung help load    The materials: sprung materials\n");
  command->callback([options, command, &invocation] { load_part(*command, *options, invocation); });
}

}  // namespace sprung
