#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace sprung {

/// The manual of the program with all its commands and options, as roff for man(1).
[[nodiscard]] std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace sprung

namespace CLI {
class Option;
}

namespace sprung {

/// The names that an option takes; empty where it takes no names, or any.
[[nodiscard]] std::vector<std::string> named_choices(const CLI::Option& option);

}  // namespace sprung

namespace sprung {

/// Where the descriptions of options and commands begin, and where lines of help end at the latest.
inline constexpr std::size_t kHelpColumn = 34;
inline constexpr std::size_t kHelpWidth = 100;

/// Help with its long lines broken between words: descriptions go on below themselves, other lines below their start.
[[nodiscard]] std::string wrapped_help(std::string_view help);

}  // namespace sprung
