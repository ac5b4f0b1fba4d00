#pragma once
#include <string_view>

namespace CLI {
class App;
}

namespace sprung {

/// Lets options of one value be repeated as far as CLI11 is concerned, whose words about it are its own;
/// refuse_repeated refuses them after parsing.
void accept_repeated(CLI::App& command);

/// Throws Error(kUsage) for an option of one value that was given several times.
void refuse_repeated(const CLI::App& command);

/// Throws Error(kUsage) for the first word that nothing was made for, with the nearest word that there is, or the
/// command that has such an option. `kind` of a word that is no option: "unexpected".
void refuse_extras(const CLI::App& command, std::string_view kind);

}  // namespace sprung
