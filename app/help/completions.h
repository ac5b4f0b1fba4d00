#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace sprung {

enum class CommandShell { kBash, kZsh, kFish };

/// What `sprung help` has something on: the scene's keys, the manual, the completions, each command.
[[nodiscard]] std::vector<std::string> help_topics(const CLI::App& app);

/// What makes a shell complete the program's commands, options and those values that are names: a script for bash or
/// fish, a function for zsh's fpath. Everything else is completed as a file.
[[nodiscard]] std::string completions(const CLI::App& app, CommandShell shell);

}  // namespace sprung
