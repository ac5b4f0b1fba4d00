#include "app/wrong_words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sprung {
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
