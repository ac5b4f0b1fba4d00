#include "render/gl/draw_timer.h"

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

void DrawTimer::start() {
  if (!is_on_) return;
  gl_.Finish();
  wall_ = wall_seconds();
  processor_ = processor_seconds();
}

void DrawTimer::stop(std::string_view pass) {
  if (!is_on_) return;
  const double wall = wall_;
  const double processor = processor_;
  start();
  auto time = std::find_if(times_.begin(), times_.end(), [pass](const DrawTime& t) { return t.pass == pass; });
  if (time == times_.end()) time = times_.insert(times_.end(), DrawTime{.pass = pass});
  time->wall += wall_ - wall;
  time->processor += processor_ - processor;
}

}  // namespace sprung
