#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "app/help/manual.h"
#include "core/text.h"

namespace sprung {
namespace {

std::vector<const CLI::Option*> named_options(const CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_lnames().empty()) options.push_back(option);
  }
  return options;
}

std::string command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return fmt::format("{}", fmt::join(names, " "));
}

/// "animate) words='--bricks --size'; case $previous in --scenario) words='drop hang';; esac;;"
std::string bash_case(const CLI::App& command, const Choices& choices_of) {
  std::string words;
  std::string values;
  for (const CLI::Option* option : named_options(command)) {
    const std::string name = "--" + option->get_lnames()[0];
    words += (words.empty() ? "" : " ") + name;
    const std::vector<std::string> choices = choices_of(*option);
    if (!choices.empty()) values += fmt::format("        {}) values='{}' ;;\n", name, fmt::join(choices, " "));
  }
  const std::string choose = values.empty() ? "" : fmt::format("      case $previous in\n{}      esac\n", values);
  return fmt::format("    {})\n      words='{}'\n{}      ;;\n", command.get_name(), words, choose);
}

std::string bash(const CLI::App& app, const Choices& choices_of) {
  std::string cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() != "help") cases += bash_case(*command, choices_of);
  }
  return fmt::format(R"(# bash completion for sprung
_sprung() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} words= values=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{0} --help --version' -- "$current"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
    help) words='{2}' values=$words ;;
{1}  esac
  if [ -n "$values" ]; then
    [ "$previous" != --set ] || compopt -o nospace 2>/dev/null
    COMPREPLY=($(compgen -W "$values" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  fi
}}
complete -o default -F _sprung sprung
)",
                     command_names(app), cases, fmt::join(help_topics(app), " "));
}

/// Escapes what is special to _arguments.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

std::string zsh_argument(const CLI::Option& option, const Choices& choices_of) {
  const std::string head = fmt::format("*--{}[{}]", option.get_lnames()[0], zsh_text(option.get_description()));
  if (option.get_items_expected_max() == 0) return shell_quoted(head);
  const std::vector<std::string> choices = choices_of(option);
  const std::string values = choices.empty() ? "_files" : fmt::format("({})", fmt::join(choices, " "));
  return shell_quoted(fmt::format("{}:{}:{}", head, zsh_text(option.get_option_text()), values));
}

std::string zsh(const CLI::App& app, const Choices& choices_of) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands += fmt::format("    {}\n", shell_quoted(command->get_name() + ":" + zsh_text(command->get_description())));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const CLI::Option* option : named_options(*command))
      cases += " \\\n      " + zsh_argument(*option, choices_of);
    cases += command->get_name() == "help"
                 ? fmt::format(" \\\n      '*:topic:({})' ;;\n", fmt::join(help_topics(app), " "))
                 : " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(R"(#compdef sprung
_sprung() {{
  local -a commands
  commands=(
{})
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_sprung "$@"
)",
                     commands, cases);
}

std::string fish(const CLI::App& app, const Choices& choices_of) {
  std::string text = "# fish completion for sprung\n";
  for (const CLI::App* command : app.get_subcommands({})) {
    text += fmt::format("complete -c sprung -n __fish_use_subcommand -f -a {} -d {}\n", command->get_name(),
                        shell_quoted(command->get_description()));
    if (command->get_name() == "help") {
      text += fmt::format("complete -c sprung -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
                          fmt::join(help_topics(app), " "));
    }
    for (const CLI::Option* option : named_options(*command)) {
      const std::vector<std::string> choices = choices_of(*option);
      text += fmt::format("complete -c sprung -n '__fish_seen_subcommand_from {}' -l {} -d {}", command->get_name(),
                          option->get_lnames()[0], shell_quoted(option->get_description()));
      if (option->get_items_expected_max() > 0) text += choices.empty() ? " -r" : " -x";
      if (!choices.empty()) text += fmt::format(" -a '{}'", fmt::join(choices, " "));
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> help_topics(const CLI::App& app) {
  std::vector<std::string> topics{"scene", "man", "bash", "zsh", "fish"};
  for (const CLI::App* command : app.get_subcommands({})) topics.push_back(command->get_name());
  return topics;
}

std::string completions(const CLI::App& app, CommandShell shell, const Choices& choices_of) {
  switch (shell) {
    case CommandShell::kZsh:
      return zsh(app, choices_of);
    case CommandShell::kFish:
      return fish(app, choices_of);
    case CommandShell::kBash:
      break;
  }
  return bash(app, choices_of);
}

}  // namespace sprung
