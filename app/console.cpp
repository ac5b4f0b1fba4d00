#include "app/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace sprung {
namespace {

constexpr std::string_view kRed = "\033[1;31m";
constexpr std::string_view kYellow = "\033[1;33m";
constexpr std::string_view kPlain = "\033[0m";

void say(std::string_view label, std::string_view color, bool has_color, std::string_view message) {
  while (true) {
    const auto end = message.find('\n');
    const std::string_view line = message.substr(0, end);
    if (has_color) {
      fmt::print(stderr, "sprung: {}{}:{} {}\n", color, label, kPlain, line);
    } else {
      fmt::print(stderr, "sprung: {}: {}\n", label, line);
    }
    if (end == std::string_view::npos) return;
    message.remove_prefix(end + 1);
  }
}

}  // namespace

Console Console::of_process() {
  const char* no_color = std::getenv("NO_COLOR");
  Console console;
  console.is_terminal = isatty(STDERR_FILENO) == 1;
  console.has_color = console.is_terminal && (no_color == nullptr || *no_color == '\0');
  return console;
}

void Console::error(std::string_view message) const { say("error", kRed, has_color, message); }

void Console::warn(std::string_view message) const { say("warning", kYellow, has_color, message); }

void Console::note(std::string_view message) const {
  if (!quiet) fmt::print(stderr, "{}\n", message);
}

void Console::detail(std::string_view message) const {
  if (verbose) note(message);
}

}  // namespace sprung
