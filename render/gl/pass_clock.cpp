#include "render/gl/pass_clock.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace sprung {

namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

void PassClock::start() {
  if (!is_on_) return;
  gl_.Finish();
  wall_ = wall_seconds();
  processor_ = processor_seconds();
}

void PassClock::stop(std::string_view pass) {
  if (!is_on_) return;
  const double wall = wall_;
  const double processor = processor_;
  start();
  auto time = std::find_if(times_.begin(), times_.end(), [pass](const PassTime& t) { return t.pass == pass; });
  if (time == times_.end()) time = times_.insert(times_.end(), PassTime{.pass = pass});
  time->wall += wall_ - wall;
  time->processor += processor_ - processor;
}

}  // namespace sprung
