#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/options.h"

namespace sprung {
namespace {

/// Includes keys of pictures, which caches record.
bool makes_scenes_with(const CLI::App& command, const OptionDefault& one) {
  const bool is_of_scenes = std::any_of(key_options().begin(), key_options().end(),
                                        [&](const KeyOption& key) { return key.option == one.option; });
  return is_of_scenes && command.get_option_no_throw("--scenario") != nullptr;
}

/// "animate, simulate": the commands that take it from this line.
std::string commands_of(const CLI::App& app, const Invocation& invocation, const OptionDefault& one) {
  const OptionDefaults& defaults = invocation.defaults;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    const CLI::Option* option = command->get_option_no_throw(one.option);
    if ((option == nullptr && !makes_scenes_with(*command, one)) || invocation.is_recorded(command, option)) continue;
    if (defaults.find(command->get_name(), one.option) == &one) names.push_back(command->get_name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void print_defaults(const CLI::App& app, const Invocation& invocation) {
  const OptionDefaults& defaults = invocation.defaults;
  if (defaults.file.empty()) {
    fmt::print(
        "no defaults of a site or project: neither does the environment variable {} name a file, nor is there a "
        "{} in {} or above it\n",
        kConfigVariable, kConfigName, std::filesystem::current_path().string());
    return;
  }
  fmt::print("{}, {}:\n", defaults.file.string(),
             defaults.is_of_environment ? fmt::format("named by {}", kConfigVariable)
                                        : "the nearest one from the working folder upwards");
  for (const OptionDefault& one : defaults.list) {
    fmt::print("{:>5}  {} = {}    of {}\n", one.line, one.option.substr(2), fmt::join(one.values, ", "),
               commands_of(app, invocation, one));
  }
}

}  // namespace

void add_config(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("config", "defaults of options that hold here, and from which file");
  add_messages(*command, invocation.console);
  command->footer(
      fmt::format("A file of defaults is TOML: an option without its dashes, with its value as typed; in a\n"
                  "table of a command's name, for that command alone:\n\n"
                  "  quality = \"high\"\n  threads = 8\n  set = [\"render.caption=ACME\"]\n  [animate]\n  resolution = "
                  "\"1920x1080\"\n\n"
                  "It is the file that {} names, or the nearest {} in the working folder or above it;\n"
                  "{}= keeps from looking. What is typed and what a scene file says win over it.",
                  kConfigVariable, kConfigName, kConfigVariable));
  command->callback([&app, &invocation] { print_defaults(app, invocation); });
}

}  // namespace sprung
