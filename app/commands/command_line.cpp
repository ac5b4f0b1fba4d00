#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/options.h"
#include "app/help/manual.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

/// Printed if only the program's name is typed.
constexpr const char* kGreeting =
    "sprung turns a surface mesh into the animation of a soft body of real material.\n\n"
    "  sprung animate bunny.obj -o bunny.mp4    a film of your mesh\n"
    "  sprung inspect bunny.obj                 what the mesh is, and what its film will cost\n"
    "  sprung materials                         what it can be made of\n\n"
    "All commands: sprung --help\n";

/// The command line, quoted for a shell.
std::string command_of(int argc, const char* const* argv) {
  std::string command;
  for (const std::string word : std::span(argv, argc)) command += (command.empty() ? "" : " ") + shell_word(word);
  return command;
}

/// The first unknown option, or else the first word.
std::string unknown_word(const std::vector<std::string>& extras) {
  const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
  const auto found = std::find_if(extras.begin(), extras.end(), is_option);
  return found == extras.end() ? extras.front() : found->substr(0, found->find('='));
}

/// "--log-json comes after the command: sprung animate --log-json", if the given command (or any, if none is given) has
/// it.
std::string known_behind(const CLI::App& app, const std::string& option) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  std::vector<const CLI::App*> commands(given.begin(), given.end());
  if (commands.empty()) commands = app.get_subcommands({});
  for (const CLI::App* command : commands) {
    if (command->get_option_no_throw(option) == nullptr) continue;
    return fmt::format("{0} comes after the command: sprung {1} {0}", option, command->get_name());
  }
  return "";
}

/// "sprung film has no --size; it is an option of sprung animate", if another command has it.
std::string known_elsewhere(const CLI::App& command, const std::string& option) {
  if (command.get_parent() == nullptr) return known_behind(command, option);
  for (const CLI::App* other : command.get_parent()->get_subcommands({})) {
    if (other == &command || other->get_option_no_throw(option) == nullptr) continue;
    return fmt::format("sprung {} has no {}; it is an option of sprung {}", command.get_name(), option,
                       other->get_name());
  }
  return "";
}

/// Throws Error(kUsage) for the first word that is neither option nor argument, with the nearest known word or the
/// command that has such an option. `kind`: what a word that is not an option is called, "unexpected".
void refuse_extras(const CLI::App& app, std::string_view kind) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return;
  // A word in the position of the command is no command, whatever options follow it.
  const std::string word = app.get_parent() == nullptr ? extras.front() : unknown_word(extras);
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

/// The help of a command without its further options. To CLI11 an option of a group without a name would have no name
/// itself, in errors too.
class ShortHelp : public CLI::Formatter {
 public:
  ShortHelp() { column_width(kHelpColumn); }
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    return group == kMoreOptions ? "" : CLI::Formatter::make_group(group, is_positional, options);
  }
};

/// Lets CLI11 accept repeated options of one value, to replace its message by that of refuse_repeated();
/// that runs after parsing.
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

/// Whether any command has the option; throws Error(kBadInput) otherwise.
void check_default(const CLI::App& app, const Invocation& invocation, const OptionDefault& one) {
  const OptionDefaults& defaults = invocation.defaults;
  const auto refuse = [&](std::string_view what) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", defaults.location(one), what));
  };
  std::vector<std::string> names;
  std::vector<std::string> options;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    if (!one.command.empty() && command->get_name() != one.command) continue;
    if (!one.command.empty() && invocation.is_recorded(command, command->get_option_no_throw(one.option))) {
      refuse(fmt::format("{} draws caches, which hold what '{}' was when they were made; give it to simulate",
                         one.command, one.option.substr(2)));
    }
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    }
  }
  const std::vector<std::string_view> commands(names.begin(), names.end());
  const std::vector<std::string_view> known(options.begin(), options.end());
  if (!one.command.empty() && std::find(names.begin(), names.end(), one.command) == names.end()) {
    refuse(fmt::format("unknown command '{}'{}", one.command, did_you_mean(one.command, commands)));
  }
  if (std::find(options.begin(), options.end(), one.option) == options.end()) {
    refuse(fmt::format("unknown option '{}'{}", one.option.substr(2), did_you_mean(one.option, known)));
  }
  if (one.option == "--output" || one.option == "--help") {
    refuse(fmt::format("'{}' is not for defaults: every run has its own", one.option.substr(2)));
  }
}

/// Gives options that were not typed the defaults of the site or project. Those that stand for keys of the scene apply
/// theirs themselves, with lower priority than a scene file.
void apply_defaults(CLI::App& app, const Invocation& invocation) {
  const OptionDefaults& defaults = invocation.defaults;
  for (const OptionDefault& one : defaults.list) check_default(app, invocation, one);
  for (CLI::App* command : app.get_subcommands()) {
    for (const OptionDefault& one : defaults.list) {
      CLI::Option* option = command->get_option_no_throw(one.option);
      const auto& by_themselves = invocation.scene_options;
      const bool is_typed = option == nullptr || option->count() > 0;
      if (is_typed || defaults.find(command->get_name(), one.option) != &one ||
          std::find(by_themselves.begin(), by_themselves.end(), option) != by_themselves.end()) {
        continue;
      }
      try {
        for (const std::string& value : one.values) option->add_result(value);
        option->run_callback();
      } catch (const CLI::ParseError& error) {
        throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", defaults.location(one), error.what()));
      }
    }
  }
}

/// Runs once everything is parsed, before the callback of the command.
void check_words(const CLI::App& app) {
  refuse_extras(app, "unknown command");
  for (const CLI::App* command : app.get_subcommands()) {
    const bool has_input = command->get_option_no_throw("INPUT") != nullptr;
    refuse_extras(*command, has_input ? "more than one input; what is" : "unexpected");
    refuse_repeated(*command);
  }
  if (app.get_subcommands().empty()) fmt::print("{}", kGreeting);
}

}  // namespace

int run_command_line(int argc, const char* const* argv, Console& console) {
  CLI::App app("Soft bodies of real materials, from a surface mesh to a film.", "sprung");
  app.set_version_flag("--version", "sprung " SPRUNG_VERSION);
  app.formatter(std::make_shared<ShortHelp>());
  app.allow_extras();
  app.require_subcommand(0, 1);
  app.footer(
      "Try: sprung animate bunny.obj -o bunny.mp4\nHelp on a command: sprung COMMAND --help\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 bad input, 4 diverged,\n130 interrupted, 143 terminated.");
  const std::span words(argv, argc);
  const bool asks_for_help = argc == 1 || std::any_of(words.begin(), words.end(), [](std::string_view word) {
                               return word == "help" || word == "--help" || word == "-h" || word == "--version";
                             });  // which no mistake in a file of defaults prevents
  Invocation invocation{.console = console,
                        .command = command_of(argc, argv),
                        .defaults = asks_for_help ? OptionDefaults{} : option_defaults()};
  for (const auto add : {add_animate, add_simulate, add_render, add_export, add_film, add_sweep, add_load, add_inspect,
                         add_validate, add_compare, add_materials, add_config, add_help}) {
    add(app, invocation);
  }
  for (CLI::App* command : app.get_subcommands({})) {
    command->allow_extras();
    accept_repeated(*command);
  }
  app.parse_complete_callback([&app, &invocation] {
    check_words(app);
    apply_defaults(app, invocation);
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    app.exit(help, text, text);
    fmt::print("{}", wrapped_help(text.str()));
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string reason = error.what();
    throw Error(ErrorKind::kUsage, fmt::format("{} needs a value", reason.substr(0, reason.find(':'))));
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, error.what());
  }
  return invocation.exit_code;
}

}  // namespace sprung
