#include "app/help/wrapped_help.h"

#include <algorithm>

namespace sprung {
namespace {

/// Spaces before what a line goes on with.
std::size_t indent_of(std::string_view line) {
  const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
  const bool has_description = start > 0 && line.size() > kHelpColumn && line[kHelpColumn - 1] == ' ';
  return has_description ? kHelpColumn : start;
}

}  // namespace

std::string wrapped_help(std::string_view help) {
  std::string wrapped;
  while (!help.empty()) {
    const std::size_t end = std::min(help.find('\n'), help.size());
    std::string line(help.substr(0, end));
    const std::size_t indent = indent_of(line);
    while (line.size() > kHelpWidth) {
      const std::size_t space = line.rfind(' ', kHelpWidth);
      if (space == std::string::npos || space <= indent) break;  // a word that is too long by itself
      wrapped += line.substr(0, line.find_last_not_of(' ', space) + 1) + "\n";
      line = std::string(indent, ' ') + line.substr(space + 1);
    }
    wrapped += line;
    if (end < help.size()) wrapped += '\n';
    help.remove_prefix(std::min(end + 1, help.size()));
  }
  return wrapped;
}

}  // namespace sprung
