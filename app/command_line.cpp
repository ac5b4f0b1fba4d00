#include "app/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "app/commands.h"
#include "app/help/completions.h"
#include "app/help/man_page.h"
#include "app/help/wrapped_help.h"
#include "app/key_options.h"
#include "app/scene/scene_keys.h"
#include "app/scene/scene_schema.h"
#include "app/scene/scene_values.h"
#include "app/wrong_words.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr const char* kVersion = SPRUNG_VERSION;

/// For a newcomer who typed the name of the program and nothing else.
constexpr const char* kGreeting =
    "sprung turns a surface mesh into the animation of a soft body of real material.\n\n"
    "  sprung animate bunny.obj -o bunny.mp4    a film of your mesh\n"
    "  sprung inspect bunny.obj                 what the mesh is, and what its film will take\n"
    "  sprung materials                         what it can be made of\n\n"
    "All commands: sprung --help\n";

std::string help_text(CLI::App& app, const CLI::App& help, const RawOptions& words) {
  refuse_extras(help, "unexpected");
  for (CLI::App* command : app.get_subcommands({})) show_all(*command);
  if (words.topic == "scene") return words.json_schema ? scene_schema() : scene_reference();
  if (words.topic == "man") return man_page(app, kVersion);
  for (const auto& [name, shell] :
       {std::pair("bash", CommandShell::kBash), {"zsh", CommandShell::kZsh}, {"fish", CommandShell::kFish}}) {
    if (words.topic == name) return completions(app, shell);
  }
  if (words.json_schema) throw Error(ErrorKind::kUsage, "--json-schema is for sprung help scene");
  const auto help_on = [](const CLI::App& command, const std::string& name) {
    return wrapped_help(command.get_formatter()->make_help(&command, name, CLI::AppFormatMode::Normal));
  };
  // The name of a command after `help` is parsed as that command.
  for (CLI::App* command : app.get_subcommands()) {
    if (command != &help) return help_on(*command, "sprung " + command->get_name());
  }
  if (words.topic.empty()) return help_on(app, app.get_name());
  if (words.topic == help.get_name()) return help_on(help, "sprung help");
  const std::vector<std::string> names = help_topics(app);
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw Error(ErrorKind::kUsage, fmt::format("no help on '{}'{}", words.topic, did_you_mean(words.topic, known)));
}

int count_in(std::string_view name, const std::string& text) {
  int count = 0;
  try {
    parse_value(text, {.name = name, .help = "", .range = {1, 4096}}, count);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--{}: {}", name, error.what()));
  }
  return count;
}

/// The words again, as a shell takes them.
std::string command_of(int argc, const char* const* argv) {
  std::string command;
  for (const std::string word : std::span(argv, argc)) {
    const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char letter) {
      return std::isalnum(letter) != 0 ||
             std::string_view("_-+=./:,@%").find(static_cast<char>(letter)) != std::string_view::npos;
    });
    std::string quoted;
    for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    command += (command.empty() ? "" : " ") + (is_plain ? word : "'" + quoted + "'");
  }
  return command;
}

/// "body.spin=[0,0,90]".
Setting setting(const std::string& text) {
  const auto sign = text.find('=');
  if (sign == 0 || sign == std::string::npos) {
    throw Error(ErrorKind::kUsage, fmt::format("--set: '{}' is not of the form KEY=VALUE", text));
  }
  return {"--set " + text.substr(0, sign), text.substr(0, sign), text.substr(sign + 1)};
}

/// One value of a key of the scene, from the words after an option.
template <class Value, class Owner>
void read_choice(const CLI::App& command, const char* option, const char* key, const std::string& text,
                 std::optional<Value>& value) {
  if (command.count(option) == 0) return;
  try {
    parse_value(text, *find_key<Owner>(key), value);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", option, error.what()));
  }
}

double error_in(const std::string& text) {
  try {
    const double error = parse_quantity(text, Dimension::kLength);
    if (error > 0) return error;
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--position-error: {}", error.what()));
  }
  throw Error(ErrorKind::kUsage, fmt::format("--position-error is a length above 0, not {}", text));
}

std::string_view input_of(std::string_view command) {
  if (command == "render") return "a cache (.h5)";
  if (command == "film") return "a folder of pictures";
  return "a mesh or a scene";
}

std::string_view outputs_of(std::string_view command) {
  if (command == "simulate") return "-o RUN.h5 or -o folder/";
  if (command == "export") return "-o skin_{:04}.obj, -o film.glb, ...; see sprung export --list";
  if (command == "film") return "-o film.mp4";
  if (command == "sweep") return "-o folder/";
  return "-o folder/, -o frame_{:04}.png or -o film.mp4";
}

bool given(const CLI::App& command, const char* option) {
  const CLI::Option* known = command.get_option_no_throw(option);
  return known != nullptr && known->count() > 0;
}

SceneOptions read_scene_options(const CLI::App& command, RawOptions& words) {
  refuse_extras(command, "more than one input; what is");
  refuse_repeated(command);
  SceneOptions options = std::move(words.scene);
  for (std::size_t i = 0; i < words.scene_values.size(); ++i) {
    const KeyOption& known = key_options()[i];
    if (!given(command, known.option)) continue;
    options.settings.push_back({known.option, std::string(known.key), words.scene_values[i]});
  }
  for (const std::string& words_of_one : words.set) options.settings.push_back(setting(words_of_one));
  if (given(command, "--bricks") && given(command, "--brick-size")) {
    throw Error(ErrorKind::kUsage, "give --bricks or --brick-size, not both");
  }
  if (!words.scenario.empty()) options.scenario = scenario_from_name(words.scenario);
  if (!words.threads.empty()) options.threads = count_in("threads", words.threads);
  if (!words.jobs.empty()) options.jobs = count_in("jobs", words.jobs);
  if (!words.position_error.empty()) options.position_error = error_in(words.position_error);
  const std::string& name = command.get_name();
  if (options.side_by_side == options.others.empty()) {
    throw Error(ErrorKind::kUsage, options.side_by_side
                                       ? "--side-by-side needs more than one cache"
                                       : fmt::format("more than one input; what is '{}'? Runs beside each other: "
                                                     "--side-by-side",
                                                     options.others.front()));
  }
  if (options.list) return options;
  if (options.input.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("{0} needs {1}; see sprung {0} --help", name, input_of(name)));
  }
  if (options.outputs.empty() && !options.print_scene && !options.table && name != "inspect") {
    throw Error(ErrorKind::kUsage, fmt::format("{} needs an output: {}", name, outputs_of(name)));
  }
  return options;
}

void read_scene_command(const CLI::App& command, RawOptions& words, CommandLine& line) {
  line.scene = read_scene_options(command, words);
}

void read_film(const CLI::App& command, RawOptions& words, CommandLine& line) {
  read_scene_command(command, words, line);
  read_choice<double, Scene>(command, "--fps", "fps", words.fps, line.scene.fps);
}

void read_materials(const CLI::App& command, RawOptions& words, CommandLine& line) {
  refuse_extras(command, "unexpected");
  refuse_repeated(command);
  line.materials = std::move(words.materials);
}

void read_validate(const CLI::App& command, RawOptions& words, CommandLine& line) {
  refuse_extras(command, "unexpected");
  refuse_repeated(command);
  line.validate = std::move(words.validate);
  auto& choice = line.validate.choice;
  read_choice<Model, SceneBody>(command, "--model", "model", words.model, choice.model);
  read_choice<double, Material>(command, "--poisson", "poisson", words.poisson, choice.poisson);
  read_choice<int, SceneBody>(command, "--bricks", "bricks", words.bricks, choice.bricks);
  line.scene.quiet = words.scene.quiet;
  line.scene.verbose = words.scene.verbose;
}

void read_compare(const CLI::App& command, RawOptions& words, CommandLine& line) {
  refuse_extras(command, "unexpected");
  refuse_repeated(command);
  line.compare = std::move(words.compare);
  if (!line.compare.second.empty()) return;
  throw Error(ErrorKind::kUsage, "compare needs two pictures: sprung compare A.png B.png");
}

/// How what was typed for a command gets into its options.
struct CommandReader {
  const char* name;
  CommandLine::Command command;
  void (*read)(const CLI::App& command, RawOptions& words, CommandLine& line);
};

constexpr std::array<CommandReader, 10> kReaders{{
    {"animate", CommandLine::Command::kAnimate, read_scene_command},
    {"simulate", CommandLine::Command::kSimulate, read_scene_command},
    {"render", CommandLine::Command::kRender, read_scene_command},
    {"export", CommandLine::Command::kExport, read_scene_command},
    {"film", CommandLine::Command::kFilm, read_film},
    {"sweep", CommandLine::Command::kSweep, read_scene_command},
    {"inspect", CommandLine::Command::kInspect, read_scene_command},
    {"validate", CommandLine::Command::kValidate, read_validate},
    {"compare", CommandLine::Command::kCompare, read_compare},
    {"materials", CommandLine::Command::kMaterials, read_materials},
}};

/// Fills the words that the commands were given. Returns what --help or --version show; else nothing.
std::optional<std::string> fill_options(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    app.exit(help, text, text);
    return wrapped_help(text.str());
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string reason = error.what();
    throw Error(ErrorKind::kUsage, fmt::format("{} needs a value", reason.substr(0, reason.find(':'))));
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, error.what());
  }
  return std::nullopt;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Soft bodies of real materials, from a surface mesh to a film.", "sprung");
  app.set_version_flag("--version", std::string("sprung ") + kVersion);
  app.get_formatter()->column_width(kHelpColumn);
  app.allow_extras();
  app.footer(
      "Try: sprung animate bunny.obj -o bunny.mp4\nHelp on a command: sprung COMMAND --help\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 bad input, 4 diverged,\n130 interrupted.");
  RawOptions words;
  add_commands(app, words);
  for (CLI::App* command : app.get_subcommands({})) accept_repeated(*command);
  CommandLine line;
  line.text = kGreeting;
  if (const std::optional<std::string> shown = fill_options(app, argc, argv)) {
    line.text = *shown;
    return line;
  }
  refuse_extras(app, "unknown command");
  if (app.got_subcommand("help")) {
    line.text = help_text(app, *app.get_subcommand("help"), words);
    return line;
  }
  for (const CommandReader& reader : kReaders) {
    if (!app.got_subcommand(reader.name)) continue;
    reader.read(*app.get_subcommand(reader.name), words, line);
    line.command = reader.command;
    line.scene.command = command_of(argc, argv);
    break;
  }
  return line;
}

}  // namespace sprung
