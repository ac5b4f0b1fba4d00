#pragma once
#include <string>
#include <string_view>

namespace sprung {

/// Where the descriptions of options and commands begin, and where lines of help end at the latest.
inline constexpr std::size_t kHelpColumn = 34;
inline constexpr std::size_t kHelpWidth = 100;

/// Help with its long lines broken between words: descriptions go on below themselves, other lines below their start.
[[nodiscard]] std::string wrapped_help(std::string_view help);

}  // namespace sprung
