#pragma once
#include <string>
#include <string_view>

namespace sprung {

/// In single quotes, for any shell.
[[nodiscard]] std::string shell_quoted(std::string_view text);

/// The same, but unquoted where no character of the text is special to a shell.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace sprung
