#pragma once
#include <string>
#include <string_view>

namespace sprung {

/// In single quotes, for any shell.
[[nodiscard]] std::string shell_quoted(std::string_view text);

/// The same, but as it is where no shell takes any of its letters for its own.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace sprung
