#include "app/console/shell_text.h"

#include <algorithm>
#include <cctype>

namespace sprung {

std::string shell_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

std::string shell_word(std::string_view text) {
  const auto is_plain = [](unsigned char letter) {
    return std::isalnum(letter) != 0 || std::string_view("_-+=./:,@%").find(char(letter)) != std::string_view::npos;
  };
  const bool needs_quotes = text.empty() || !std::all_of(text.begin(), text.end(), is_plain);
  return needs_quotes ? shell_quoted(text) : std::string(text);
}

}  // namespace sprung
