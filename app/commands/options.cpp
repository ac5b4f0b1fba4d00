#include "app/commands/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>

#include "app/scene/carrying_material.h"
#include "app/scene/scene_file.h"
#include "core/files.h"
#include "core/mesh/io/read_mesh.h"
#include "core/text.h"

namespace sprung {
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

/// "body.spin=[0,0,90]".
Setting parse_set(const std::string& text) {
  const auto sign = text.find('=');
  if (sign == 0 || sign == std::string::npos) {
    throw Error(ErrorKind::kUsage, fmt::format("--set: '{}' is not of the form KEY=VALUE", text));
  }
  return {"--set " + text.substr(0, sign), text.substr(0, sign), text.substr(sign + 1)};
}

bool is_of_materials(const Setting& setting) { return setting.key == "materials"; }

/// --material auto.
bool is_auto_material(const Setting& setting) { return setting.key == "body.material" && setting.value == "auto"; }

/// The materials known by name, also in a scene file that names no file of materials itself.
std::shared_ptr<const MaterialLibrary> library_of(const std::vector<Setting>& settings) {
  if (std::none_of(settings.begin(), settings.end(), is_of_materials)) return built_in_materials();
  auto library = std::make_shared<MaterialLibrary>(*built_in_materials());
  for (const Setting& setting : settings) {
    if (is_of_materials(setting)) library->add_file(setting.value);
  }
  return library;
}

Film bare_mesh(const std::filesystem::path& mesh, const std::shared_ptr<const MaterialLibrary>& library) {
  Film scene;
  scene.library = library;
  scene.bodies.emplace_back(default_body()).mesh = std::filesystem::absolute(mesh).lexically_normal();
  return scene;
}

/// Sides of the mesh's bounding box, x, y, z, in file units.
Vec3 extent_of(const std::filesystem::path& mesh) {
  const Points points = read_mesh(mesh).positions;
  return points.colwise().maxCoeff() - points.colwise().minCoeff();
}

/// STL and 3MF come from printing, where z is up as in Blender; readers turn files that name an axis.
UpAxis usual_up(const std::filesystem::path& mesh) {
  const std::string extension = lower_extension(mesh);
  return extension == ".stl" || extension == ".3mf" || extension == ".blend" ? UpAxis::kZ : UpAxis::kY;
}

constexpr std::array<std::string_view, 3> kUps{"y", "z", "auto"};

std::optional<UpAxis> up_from_name(std::string_view name) {
  if (name.empty() || name == "auto") return std::nullopt;
  if (name == "y") return UpAxis::kY;
  if (name == "z") return UpAxis::kZ;
  throw Error(ErrorKind::kUsage, fmt::format("--up: '{}' is not a vertical axis{}", name, did_you_mean(name, kUps)));
}

struct NamedDirection {
  std::string_view name;
  CameraDirection view;
};
constexpr std::array<NamedDirection, 6> kDirections{{{"front", {0, std::nullopt}},
                                                     {"back", {180, std::nullopt}},
                                                     {"left", {-90, std::nullopt}},
                                                     {"right", {90, std::nullopt}},
                                                     {"top", {0, 85}},
                                                     {"three-quarter", {30, std::nullopt}}}};

/// A name, or degrees about the vertical.
CameraDirection view_from_text(const std::string& text) {
  std::vector<std::string_view> names;
  for (const NamedDirection& named : kDirections) {
    if (named.name == text) return named.view;
    names.push_back(named.name);
  }
  CameraDirection view;
  try {
    parse_value(text, {.name = "--view", .help = "", .dimension = Dimension::kAngle}, view.azimuth);
  } catch (const Error&) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--view: '{}' is neither a direction nor degrees{}", text, did_you_mean(text, names)));
  }
  return view;
}

/// Flat bodies are looked at from higher up, and bodies at rest fill a good part of the picture.
void place_camera(SceneCamera& camera, double height, double width) {
  constexpr double kFlatness = 0.6;  // height over width below which the camera rises
  constexpr double kRise = 22;       // degrees, for a body without height
  constexpr double kBodyHeight = 0.46;
  camera.elevation += kRise * std::clamp(1 - height / (kFlatness * width), 0.0, 1.0);
  camera.body_height = kBodyHeight;
}

}  // namespace

void add_messages(CLI::App& command, Console& console, const std::string& verbose) {
  command.add_flag("--quiet", console.quiet, "warnings and errors only");
  command.add_flag("--verbose", console.verbose, verbose);
  command.add_flag("--log-json", console.log_json, "messages and progress as JSON on stderr, one object per line");
}

int count_in(std::string_view option, const std::string& text) {
  int count = 0;
  if (text.empty()) return count;
  try {
    parse_value(text, {.name = option, .help = "", .range = {1, 4096}}, count);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", option, error.what()));
  }
  return count;
}

void refuse_existing(const std::filesystem::path& file, bool overwrite, std::string_view remedy) {
  if (overwrite || !std::filesystem::exists(file)) return;
  throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say {}", file.string(), remedy));
}

void OutputOptions::add_to(CLI::App& command, const std::string& help, const char* placeholder) {
  command.add_option("-o,--output", names, help)->allow_extra_args(false)->option_text(placeholder);
}

void OutputOptions::require(const CLI::App& command, std::string_view example) const {
  if (!names.empty()) return;
  throw Error(ErrorKind::kUsage, fmt::format("{} needs an output: {}", command.get_name(), example));
}

void require_input(const CLI::App& command, const std::string& input, std::string_view what) {
  if (!input.empty()) return;
  throw Error(ErrorKind::kUsage, fmt::format("{0} needs {1}; see sprung {0} --help", command.get_name(), what));
}

CLI::Option* JobOptions::add_to(CLI::App& command) {
  return command
      .add_option("--jobs", text, "number of processes that draw; default: one per core, for at least 24 frames each")
      ->option_text("N");
}

std::span<const KeyOption> key_options() { return kKeyOptions; }

void apply(const Setting& setting, Film& scene) {
  try {
    set_scene_key(scene, setting.key, setting.value);
    if (setting.key == "render.quality") scene.render.samples.reset();  // what is typed wins over the scene's
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", setting.option, error.what()));
  }
}

void SettingOptions::add_keys(CLI::App& command, const std::function<bool(const KeyOption&)>& is_meant) {
  for (const KeyOption& key : kKeyOptions) {
    if (!is_meant(key)) continue;
    Word& word = words_.emplace_back(Word{.key = key, .text = {}});
    CLI::Option* option = command.add_option(key.option, word.text, std::string(key_at(key.key).help));
    option->option_text(key.example);
    if (!key.use.is_common) option->group(kMoreOptions);
    word.option = option;
  }
}

void SettingOptions::add_set(CLI::App& command, const std::string& help, const char* placeholder) {
  command.add_option("--set", sets_, help + "; may be given several times")
      ->allow_extra_args(false)
      ->option_text(placeholder);
}

std::vector<Setting> SettingOptions::settings() const {
  std::vector<Setting> settings;
  for (const Word& word : words_) {
    if (word.option->count() > 0) settings.push_back({word.key.option, std::string(word.key.key), word.text});
  }
  const auto is_given = [&](std::string_view option) {
    return std::any_of(settings.begin(), settings.end(), [&](const Setting& one) { return one.option == option; });
  };
  if (is_given("--bricks") && is_given("--brick-size")) {
    throw Error(ErrorKind::kUsage, "give --bricks or --brick-size, not both");
  }
  for (const std::string& text : sets_) settings.push_back(parse_set(text));
  return settings;
}

namespace {

/// Sets the softest material that carries the body of a bare mesh, its size where even the stiffest does not, and the
/// time steps that are faster for it.
void choose_material(Film& scene, const SceneRequest& request, Scenario scenario, const Observer& observer) {
  SceneBody& body = scene.bodies[0];
  const auto is_given = [&](std::string_view key) {
    return std::any_of(request.settings.begin(), request.settings.end(),
                       [&](const Setting& setting) { return setting.key == key; });
  };
  const bool is_sized = body.size || body.scale;
  const Support support = scenario == Scenario::kHang ? Support::kHangs : Support::kStands;
  const std::optional<CarryingMaterial> found =
      softest_carrying(body, support, scene.gravity, !is_sized, *scene.library, observer);
  if (!found) {
    observer.warn(fmt::format("material: no elastomer of the library carries {}; it stays {}",
                              body.mesh.filename().string(), body.material.name));
    return;
  }
  body.material = found->material->material();
  const bool is_smaller = !is_sized && found->size < 0.99 * kDefaultSize;
  if (is_smaller) body.size = found->size;
  if (!is_given("solver.scheme")) scene.solver.scheme = Solver::kAuto;
  observer.note(fmt::format("material: {}, the softest that {} (sags {:.1f} %){}; --material gelatin for a dessert",
                            body.material.name, scenario == Scenario::kHang ? "hangs in shape" : "stands",
                            100 * found->sag,
                            is_smaller ? fmt::format(" at {}", readable(found->size, Dimension::kLength)) : ""));
}

}  // namespace

Film make_scene(const SceneRequest& request, const Observer& observer) {
  const bool is_scene = is_scene_file(request.input);
  if (is_scene && request.scenario) {
    throw Error(ErrorKind::kUsage, "--scenario is for a bare mesh; a scene file says what happens");
  }
  if (is_scene && request.up) {
    throw Error(ErrorKind::kUsage, "--up is for a bare mesh; in a scene file body.rotation = [-90, 0, 0] puts z up");
  }
  const auto library = library_of(request.settings);
  Film scene = is_scene ? read_scene(request.input, *library) : bare_mesh(request.input, library);
  const UpAxis up = request.up.value_or(usual_up(request.input));
  Vec3 extent = Vec3::Ones();
  if (!is_scene) {
    extent = extent_of(scene.bodies[0].mesh);
    if (up == UpAxis::kZ) std::swap(extent.y(), extent.z());
    place_camera(scene.camera, extent.y(), std::max(extent.x(), extent.z()));
    stand_upright(scene, up);
  }
  if (request.view) {
    scene.camera.azimuth = request.view->azimuth;
    if (request.view->elevation) scene.camera.elevation = *request.view->elevation;
    scene.camera.keyframes.clear();
  }
  for (const Setting& setting : request.settings) {
    if (is_auto_material(setting) && !is_scene) continue;
    if (!is_of_materials(setting)) apply(setting, scene);
  }
  if (is_scene) return scene;
  const Scenario scenario = request.scenario.value_or(Scenario::kDrop);
  if (std::any_of(request.settings.begin(), request.settings.end(), is_auto_material)) {
    choose_material(scene, request, scenario, observer);
  }
  const SceneBody& body = scene.bodies[0];
  const double scale = body.scale.value_or(body.size.value_or(kDefaultSize) / extent.maxCoeff());
  stage_scenario(scene, scenario, scale * extent.y(), up);
  return scene;
}

void SceneOptions::add_to(CLI::App& command, bool has_pictures, const std::string& input_help) {
  command.add_option("INPUT", input, input_help);
  keys.add_keys(command, [&](const KeyOption& key) { return has_pictures || !key.use.is_of_pictures; });
  keys.add_set(command, "any key of a scene (sprung help scene)");
  command
      .add_option("--scenario", scenario, fmt::format("what a bare mesh does: {}", fmt::join(scenario_names(), ", ")))
      ->option_text("NAME");
  command.add_option("--up", up, "vertical axis of a bare mesh: y, z or auto (z for STL, 3MF, BLEND)")
      ->option_text("AXIS")
      ->group(kMoreOptions);
  if (has_pictures) {
    command.add_option("--view", view, "front, back, left, right, top, three-quarter, or degrees")->option_text("NAME");
  }
  command.add_option("--threads", threads, "threads of the simulation; default: all cores")
      ->option_text("N")
      ->group(kMoreOptions);
  command.add_flag("--print-scene", print_scene, "write the scene as resolved to stdout, and stop");
}

SceneRequest SceneOptions::request() const {
  SceneRequest request{.input = input, .settings = keys.settings()};
  if (!scenario.empty()) request.scenario = scenario_from_name(scenario);
  request.up = up_from_name(up);
  if (!view.empty()) request.view = view_from_text(view);
  return request;
}

void SceneOptions::with_scene(const Console& console, const std::function<void(const Film&)>& work) const {
  const int thread_count = count_in("--threads", threads);
  const SceneRequest wanted = request();
  const Film scene = make_scene(wanted, console);
  if (!wanted.up && !is_scene_file(input) && usual_up(input) == UpAxis::kZ) {
    console.note("up: z, as in most files of this format; --up y if the mesh lies on its side");
  }
  if (print_scene) {
    fmt::print("{}", sprung::print_scene(with_defaults(scene)));
    return;
  }
  std::optional<tbb::global_control> control;
  if (thread_count > 0) control.emplace(tbb::global_control::max_allowed_parallelism, thread_count);
  work(scene);
}

std::string scene_footer(const CLI::App& command, const std::string& examples) {
  return examples +
         "Lengths, times, pressures and densities take a unit (\"3 cm\", 20kPa, 1.2g/cm3); a bare number is SI.\n"
         "Options override the scene file, which overrides the defaults.\n"
         "All options: sprung help " +
         command.get_name() + "    All keys of a scene: sprung help scene";
}

}  // namespace sprung
