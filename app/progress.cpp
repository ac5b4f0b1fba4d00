#include "app/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/json_text.h"

namespace sprung {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::milliseconds kReport{1000};

}  // namespace

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 3 * 86400) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  return whole < 3 * 365 * 86400L ? fmt::format("{} days", whole / 86400)
                                  : fmt::format("{} years", whole / (365 * 86400L));
}

Progress::Progress(const Console& console, std::string stage, double total, double scale, std::string rate_unit)
    : console_(console), stage_(std::move(stage)), total_(total), scale_(scale), rate_unit_(std::move(rate_unit)) {
  draw();
}

Progress::~Progress() { clear(); }

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

double Progress::seconds_to_go() const { return done_ > 0 ? seconds() * (total_ - done_) / done_ : 0; }

std::string Progress::rate() const {
  if (rate_unit_.empty() || done_ <= 0) return "";
  return fmt::format("{:.3g} {}", scale_ * done_ / std::max(seconds(), 1e-9), rate_unit_);
}

void Progress::update(double done) {
  done_ = done;
  if (Clock::now() - last_draw_ >= (console_.log_json ? kReport : kRedraw)) draw();
}

void Progress::draw() {
  if (console_.quiet || (!console_.is_terminal && !console_.log_json)) return;
  last_draw_ = Clock::now();
  if (console_.log_json) {
    report();
    return;
  }
  is_drawn_ = true;
  const double part = total_ > 0 ? std::clamp(done_ / total_, 0.0, 1.0) : 0;
  const int filled = int(part * kBarWidth);
  std::string line = fmt::format("\r\033[K{:<9} ", stage_);
  if (total_ > 0) line += fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", filled, "", kBarWidth - filled, 100 * part);
  if (done_ > 0) line += fmt::format("  {}  {} to go", rate(), duration_text(seconds_to_go()));
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

void Progress::report() const {
  const double share = total_ > 0 ? std::clamp(done_ / total_, 0.0, 1.0) : 0;
  console_.event("progress", fmt::format(R"("stage": {}, "share": {:.4g}, "seconds": {:.3f}, "seconds_to_go": {})",
                                         json_text(std::string_view(stage_)), share, seconds(),
                                         done_ > 0 ? fmt::format("{:.3f}", seconds_to_go()) : "null"));
}

void Progress::clear() {
  if (is_drawn_) fmt::print(stderr, "\r\033[K");
  is_drawn_ = false;
}

void Progress::finish(const std::string& summary) {
  clear();
  if (console_.log_json) {
    if (console_.quiet) return;
    console_.event("stage",
                   fmt::format(R"("stage": {}, "seconds": {:.3f}, "result": {})", json_text(std::string_view(stage_)),
                               seconds(), json_text(std::string_view(summary))));
    return;
  }
  const std::string speed = rate();
  console_.note(fmt::format("{:<9} {:6.1f} s  {}{}{}", stage_, seconds(), summary, speed.empty() ? "" : "; ", speed));
}

}  // namespace sprung
