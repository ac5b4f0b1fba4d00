#include "app/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "app/json_text.h"

namespace sprung {
namespace {

constexpr std::string_view kRed = "\033[1;31m";
constexpr std::string_view kYellow = "\033[1;33m";
constexpr std::string_view kPlain = "\033[0m";

constexpr std::string_view kClearLine = "\r\033[K";

void print_line(const Console& console, std::string_view line) {
  fmt::print(stderr, "{}{}\n", console.is_terminal ? kClearLine : "", line);
}

void say(const Console& console, std::string_view label, std::string_view color, std::string_view message) {
  if (console.log_json) {
    console.event(label, fmt::format(R"("message": {})", json_text(message)));
    return;
  }
  const std::string start =
      console.has_color ? fmt::format("sprung: {}{}:{} ", color, label, kPlain) : fmt::format("sprung: {}: ", label);
  while (true) {
    const auto end = message.find('\n');
    print_line(console, fmt::format("{}{}", start, message.substr(0, end)));
    if (end == std::string_view::npos) return;
    message.remove_prefix(end + 1);
  }
}

}  // namespace

Console Console::of_process() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  Console console;
  console.is_terminal = isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
  console.has_color = console.is_terminal && (no_color == nullptr || *no_color == '\0');
  return console;
}

void Console::error(std::string_view message) const { say(*this, "error", kRed, message); }

void Console::warn(std::string_view message) const {
  say(*this, "warning", kYellow, message);
  if (warnings != nullptr) warnings->emplace_back(message);
}

void Console::note(std::string_view message) const {
  if (quiet) return;
  if (log_json) {
    event("note", fmt::format(R"("message": {})", json_text(message)));
  } else {
    print_line(*this, message);
  }
}

void Console::event(std::string_view kind, std::string_view members) const {
  fmt::print(stderr, "{{\"kind\": {}, {}}}\n", json_text(kind), members);
}

void Console::detail(std::string_view message) const {
  if (verbose) note(message);
}

}  // namespace sprung
