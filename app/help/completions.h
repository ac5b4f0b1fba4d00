#pragma once
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace sprung {

enum class CommandShell { kBash, kZsh, kFish };

/// What makes a shell complete the program's commands, options and those values that are names: a script for bash or
/// fish, a function for zsh's fpath. Everything else is completed as a file.
[[nodiscard]] std::string completions(const CLI::App& app, CommandShell shell);

}  // namespace sprung
