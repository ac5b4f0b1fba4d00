#include "app/commands/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>

#include "app/console/interrupt.h"
#include "app/scene/scene_file.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr std::array<KeyOption, 24> kKeyOptions{{
    {"--material", "body.material", "NAME", {.is_common = true}},
    {"--materials", "materials", "FILE.toml"},
    {"--young", "body.material.young", "20kPa", {.is_common = true}},
    {"--poisson", "body.material.poisson", "0.45"},
    {"--density", "body.material.density", "1.1g/cm3"},
    {"--damping", "body.material.damping", "0.03"},
    {"--size", "body.size", "12cm", {.is_common = true}},
    {"--scale", "body.scale", "1mm"},
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
    {"--quality", "render.quality", "NAME", {.is_of_pictures = true, .is_common = true}},
    {"--samples", "render.samples", "N", {.is_of_pictures = true}},
    {"--smooth", "render.smooth", "on|off", {.is_of_pictures = true}},
    {"--color-by", "render.color_by", "FIELD", {.is_of_pictures = true, .is_common = true}},
}};

/// "body.spin=[0,0,90]".
Setting parse_set(const std::string& text, const std::string& place = "") {
  const auto sign = text.find('=');
  const std::string option = place + "--set";
  if (sign == 0 || sign == std::string::npos) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' is not of the form KEY=VALUE", option, text));
  }
  return {option + ' ' + text.substr(0, sign), text.substr(0, sign), text.substr(sign + 1)};
}

constexpr std::array<std::string_view, 3> kUps{"y", "z", "auto"};

std::optional<UpAxis> up_from_name(std::string_view name) {
  if (name.empty() || name == "auto") return std::nullopt;
  if (name == "y") return UpAxis::kY;
  if (name == "z") return UpAxis::kZ;
  throw Error(ErrorKind::kUsage, fmt::format("--up: '{}' is not a vertical axis{}", name, did_you_mean(name, kUps)));
}

/// A mesh in its own size.
void add_unit(const std::string& unit, SceneRequest& request) {
  if (is_scene_file(request.input)) {
    throw Error(ErrorKind::kUsage, "--unit is for a bare mesh; in a scene file, body.scale = 0.001 is a file in mm");
  }
  for (const Setting& setting : request.settings) {
    if (setting.key != "body.size" && setting.key != "body.scale") continue;
    throw Error(ErrorKind::kUsage, fmt::format("give --unit or {}, not both", setting.option));
  }
  request.settings.push_back({"--unit", "body.scale", fmt::format("{}", metres_in(unit))});
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

}  // namespace

void add_messages(CLI::App& command, Console& console, const std::string& verbose) {
  command.add_flag("--quiet", console.quiet, "warnings and errors only");
  command.add_flag("--verbose", console.verbose, verbose);
  command.add_flag("--log-json", console.log_json, "messages and progress as JSON on stderr, one object per line");
}

namespace {

int whole_number_in(std::string_view option, const std::string& text, double least, double most) {
  int number = 0;
  try {
    parse_value(text, {.name = option, .help = "", .range = {least, most}}, number);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", option, error.what()));
  }
  return number;
}

}  // namespace

int count_in(std::string_view option, const std::string& text) {
  return text.empty() ? 0 : whole_number_in(option, text, 1, 4096);
}

void refuse_existing(const std::filesystem::path& file, bool overwrite, std::string_view remedy) {
  if (overwrite || !std::filesystem::exists(file)) return;
  throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say {}", file.string(), remedy));
}

void clear_beyond(const Output& output, int last, const Console& console) {
  const int removed = remove_beyond(output, last);
  if (removed == 0) return;
  console.note(fmt::format("{}: removed {} of an earlier, longer film", output.picture(1).parent_path().string(),
                           count_of(removed, "picture")));
}

void FrameOptions::add_to(CLI::App& command) {
  CLI::Option* range = command.add_option("--frames", frames, "these only, counted from 1; default: all");
  CLI::Option* one = command.add_option("--frame", frame, "this one only, for -o still.png");
  CLI::Option* moment = command.add_option("--time", time, "the frame at this time only, for -o still.png");
  range->option_text("A:B:STEP")->excludes(one)->excludes(moment);
  one->option_text("N")->excludes(moment)->group(kMoreOptions);
  moment->option_text("0.5s");
  command.add_option("--start-number", start_number, "number of the picture of the film's first frame; default: 1")
      ->option_text("N")
      ->group(kMoreOptions);
}

FrameChoice FrameOptions::choice(std::size_t frames_in_film, double fps) const {
  const auto range = [&] {
    if (!time.empty()) return parse_frame_time(time, frames_in_film, fps);
    if (frame.empty()) return parse_frame_range(frames, frames_in_film);
    const int number = whole_number_in("--frame", frame, 1, double(frames_in_film));
    return FrameRange{.first = number, .last = number, .step = 1};
  };
  const int start = start_number.empty() ? 1 : whole_number_in("--start-number", start_number, 0, 1e6);
  return {.range = range(), .start_number = start, .skips_existing = false};
}

void OutputOptions::add_to(CLI::App& command, const std::string& help, const char* placeholder) {
  command.add_option("-o,--output", names, help)->allow_extra_args(false)->option_text(placeholder);
}

void OutputOptions::print() const {
  const auto is_stream = [](const std::string& name) { return name == "-" || name.starts_with("-."); };
  if (std::any_of(names.begin(), names.end(), is_stream)) return;
  for (const std::string& name : names) fmt::print("{}\n", name);
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

std::vector<Setting> default_settings(const OptionDefaults& defaults, std::string_view command,
                                      const std::function<bool(const KeyOption&)>& is_meant) {
  std::vector<Setting> settings;
  for (const KeyOption& key : kKeyOptions) {
    const OptionDefault* wanted = is_meant(key) ? defaults.find(command, key.option) : nullptr;
    if (wanted == nullptr) continue;
    settings.push_back(
        {fmt::format("{}: {}", defaults.location(*wanted), key.option), std::string(key.key), wanted->values.front()});
  }
  return settings;
}

std::vector<Setting> default_settings(const OptionDefaults& defaults, std::string_view command) {
  std::vector<Setting> settings = default_settings(defaults, command, [](const KeyOption&) { return true; });
  const OptionDefault* sets = defaults.find(command, "--set");
  for (std::size_t i = 0; sets != nullptr && i < sets->values.size(); ++i) {
    settings.push_back(parse_set(sets->values[i], defaults.location(*sets) + ": "));
  }
  return settings;
}

void SettingOptions::add_keys(CLI::App& command, Invocation& invocation,
                              const std::function<bool(const KeyOption&)>& is_meant) {
  for (const KeyOption& key : kKeyOptions) {
    if (!is_meant(key)) continue;
    Word& word = words_.emplace_back(Word{.key = key, .text = {}});
    CLI::Option* option = command.add_option(key.option, word.text, std::string(key_at(key.key).help));
    option->option_text(key.example);
    if (!key.use.is_common) option->group(kMoreOptions);
    word.option = option;
    invocation.scene_options.push_back(option);
  }
}

void SettingOptions::add_set(CLI::App& command, Invocation& invocation, const std::string& help,
                             const char* placeholder) {
  CLI::Option* option = command.add_option("--set", sets_, help + "; may be given several times")
                            ->allow_extra_args(false)
                            ->option_text(placeholder);
  invocation.scene_options.push_back(option);
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
  if (is_given("--size") && is_given("--scale")) throw Error(ErrorKind::kUsage, "give --size or --scale, not both");
  for (const std::string& text : sets_) settings.push_back(parse_set(text));
  return settings;
}

void SceneOptions::add_to(CLI::App& command, Invocation& invocation, bool has_pictures, const std::string& input_help) {
  command.add_option("INPUT", input, input_help);
  keys.add_keys(command, invocation, [&](const KeyOption& key) { return has_pictures || !key.use.is_of_pictures; });
  keys.add_set(command, invocation, "any key of a scene (sprung help scene)");
  defaults = default_settings(invocation.defaults, command.get_name());
  command
      .add_option("--scenario", scenario, fmt::format("what a bare mesh does: {}", fmt::join(scenario_names(), ", ")))
      ->option_text("NAME");
  command.add_option("--unit", unit, "unit of the file of a bare mesh, in place of --size: mm, cm, m, in")
      ->option_text("mm")
      ->group(kMoreOptions);
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
  SceneRequest request{.input = input, .settings = keys.settings(), .defaults = defaults};
  if (!unit.empty()) add_unit(unit, request);
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
  limit_time(scene.solver.time_limit);
  work(scene);
}

std::string scene_footer(const CLI::App& command, const std::string& examples) {
  return examples +
         "Lengths, times, pressures and densities take a unit (\"3 cm\", 20kPa, 1.2g/cm3); a bare number is SI.\n"
         "Options override the scene file, which overrides the defaults (sprung help config).\n"
         "All options: sprung help " +
         command.get_name() + "    All keys of a scene: sprung help scene";
}

}  // namespace sprung
