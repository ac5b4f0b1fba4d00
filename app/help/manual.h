#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sprung {

/// The manual of the program with all its commands and options, as roff for man(1).
[[nodiscard]] std::string man_page(const CLI::App& app, const std::string& version);

/// The topics of `sprung help`: the scene's keys, the manual, the completions, each command.
[[nodiscard]] std::vector<std::string> help_topics(const CLI::App& app);

enum class CommandShell { kBash, kZsh, kFish };

/// The names that an option accepts; empty if it accepts none, or any.
using Choices = std::function<std::vector<std::string>(const CLI::Option&)>;

/// Completion of the program's commands, options and those values that are names: a script for bash or fish, a function
/// for zsh's fpath. Everything else is completed as a file.
[[nodiscard]] std::string completions(const CLI::App& app, CommandShell shell, const Choices& choices_of);

/// The column at which descriptions of options and commands begin, and the largest width of lines of help.
inline constexpr std::size_t kHelpColumn = 34;
inline constexpr std::size_t kHelpWidth = 100;

/// Help with its long lines broken between words: descriptions continue below themselves, other lines below their
/// start.
[[nodiscard]] std::string wrapped_help(std::string_view help);

}  // namespace sprung
