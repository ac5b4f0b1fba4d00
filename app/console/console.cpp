#include "app/console/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/console/crossings_json.h"
#include "app/console/interrupt.h"
#include "core/units.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kRed = "\033[1;31m";
constexpr std::string_view kYellow = "\033[1;33m";
constexpr std::string_view kPlain = "\033[0m";

constexpr std::string_view kClearLine = "\r\033[K";

void print_line(const Console& console, std::string_view line) {
  fmt::print(stderr, "{}{}\n", console.is_terminal ? kClearLine : "", line);
}

void print_event(const Json& event) {
  fmt::print(stderr, "{}\n", event.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void say(const Console& console, std::string_view label, std::string_view color, std::string_view message) {
  if (console.log_json) {
    print_event({{"kind", label}, {"message", message}});
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

Console Console::terse() {
  Console console;
  console.quiet = true;
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
    print_event({{"kind", "note"}, {"message", message}});
  } else {
    print_line(*this, message);
  }
}

void Console::detail(std::string_view message) const {
  if (verbose) note(message);
}

namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::milliseconds kReport{1000};

std::string rate_text(const Progress& progress) {
  return progress.rate() > 0 ? fmt::format("{:.3g} {}", progress.rate(), progress.rate_unit()) : "";
}

double share_done(const Progress& progress) {
  return progress.total() > 0 ? std::clamp(progress.done() / progress.total(), 0.0, 1.0) : 0;
}

std::string bar_of(const Progress& progress) {
  std::string line = fmt::format("{}{:<9} ", kClearLine, progress.name());
  const double share = share_done(progress);
  const int filled = int(share * kBarWidth);
  if (progress.total() > 0) {
    line += fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", filled, "", kBarWidth - filled, 100 * share);
  }
  if (progress.done() > 0) {
    line += fmt::format("  {}  {} to go", rate_text(progress), duration_text(progress.seconds_to_go()));
  }
  return line;
}

}  // namespace

void Console::look_at(const Crossings& crossings) const {
  if (quiet || !log_json) return;
  Json event{{"kind", "frame"}};
  event.update(json_of(crossings));
  print_event(event);
}

void Console::show(const Progress& progress) const {
  if (quiet || (!is_terminal && !log_json)) return;
  const auto now = std::chrono::steady_clock::now();
  if (progress.done() > 0 && now - shown_at_ < (log_json ? kReport : kRedraw)) return;
  shown_at_ = now;
  if (log_json) {
    print_event({{"kind", "progress"},
                 {"stage", progress.name()},
                 {"share", share_done(progress)},
                 {"seconds", progress.seconds()},
                 {"seconds_to_go", progress.done() > 0 ? Json(progress.seconds_to_go()) : Json()}});
    return;
  }
  has_bar_ = true;
  fmt::print(stderr, "{}", bar_of(progress));
  std::fflush(stderr);
}

void Console::clear(const Progress&) const {
  if (has_bar_) fmt::print(stderr, "{}", kClearLine);
  has_bar_ = false;
}

void Console::finish(const Progress& progress, std::string_view result) const {
  clear(progress);
  if (log_json) {
    if (quiet) return;
    print_event({{"kind", "stage"}, {"stage", progress.name()}, {"seconds", progress.seconds()}, {"result", result}});
    return;
  }
  const std::string speed = rate_text(progress);
  note(fmt::format("{:<9} {:6.1f} s  {}{}{}", progress.name(), progress.seconds(), result, speed.empty() ? "" : "; ",
                   speed));
}

void Console::check_interrupt() const { stop_if_interrupted(); }

}  // namespace sprung
