#include "app/commands/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "app/help/completions.h"
#include "app/help/manual.h"
#include "app/scene/make_scene.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_reference.h"
#include "app/scene/scene_values.h"
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
template <class Value>
void read_choice(const CLI::App& command, const char* option, const char* key, const std::string& text,
                 std::optional<Value>& value) {
  if (command.count(option) == 0) return;
  try {
    parse_value(text, key_at(key), value);
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
  read_choice<double>(command, "--fps", "fps", words.fps, line.scene.fps);
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
  read_choice<Model>(command, "--model", "body.model", words.model, choice.model);
  read_choice<double>(command, "--poisson", "body.material.poisson", words.poisson, choice.poisson);
  read_choice<int>(command, "--bricks", "body.bricks", words.bricks, choice.bricks);
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

void with_scene(const SceneOptions& options, const std::function<void(const Film&)>& work) {
  const Film scene = make_scene(options);
  if (options.print_scene) {
    fmt::print("{}", print_scene(with_defaults(scene)));
    return;
  }
  std::optional<tbb::global_control> threads;
  if (options.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
  }
  work(scene);
}

namespace {

/// The first word that nothing was made for, or else the first of all.
std::string strange_word(const std::vector<std::string>& extras) {
  const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
  const auto found = std::find_if(extras.begin(), extras.end(), is_option);
  return found == extras.end() ? extras.front() : found->substr(0, found->find('='));
}

/// "--log-json stands behind the command: sprung animate --log-json", where a command has it: the one that was given.
std::string known_behind(const CLI::App& app, const std::string& option) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  std::vector<const CLI::App*> commands(given.begin(), given.end());
  if (commands.empty()) commands = app.get_subcommands({});
  for (const CLI::App* command : commands) {
    if (command->get_option_no_throw(option) == nullptr) continue;
    return fmt::format("{0} stands behind the command: sprung {1} {0}", option, command->get_name());
  }
  return "";
}

/// "sprung film has no --size; it is an option of sprung animate", where another command has it.
std::string known_elsewhere(const CLI::App& command, const std::string& option) {
  if (command.get_parent() == nullptr) return known_behind(command, option);
  for (const CLI::App* other : command.get_parent()->get_subcommands({})) {
    if (other == &command || other->get_option_no_throw(option) == nullptr) continue;
    return fmt::format("sprung {} has no {}; it is an option of sprung {}", command.get_name(), option,
                       other->get_name());
  }
  return "";
}

}  // namespace

void accept_repeated(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 1) option->take_last();
  }
}

void refuse_repeated(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() != 1 || option->count() < 2) continue;
    throw Error(ErrorKind::kUsage,
                fmt::format("{} is given {} times; give it once", option->get_name(), option->count()));
  }
}

void refuse_extras(const CLI::App& app, std::string_view kind) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return;
  // What stands in the place of the command is no command, whatever options come after it.
  const std::string word = app.get_parent() == nullptr ? extras.front() : strange_word(extras);
  const bool is_option = word.starts_with('-');
  std::vector<std::string> known;
  if (is_option) {
    if (const std::string place = known_elsewhere(app, word); !place.empty()) throw Error(ErrorKind::kUsage, place);
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
  } else {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  }
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::string hint = views.empty() ? "" : did_you_mean(word, views);
  throw Error(ErrorKind::kUsage, fmt::format("{} '{}'{}", is_option ? "unknown option" : kind, word, hint));
}

}  // namespace sprung
