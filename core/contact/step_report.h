#pragma once
#include <chrono>

#include "core/contact/pairs/guard_counts.h"

namespace sprung {

/// Counts what explicit steps of groups of bodies did, and the seconds that they took on the threads that ran the
/// groups.
struct StepReport {
  GuardCounts guard;
  double contacts = 0;  // that carried a load, summed over the steps
  double springs = 0;   // s: springs, damping and loads
  double search = 0;    // s: nearby features found and measured
  double sweeps = 0;    // s
  double guarding = 0;  // s: the guard, with the search again where velocities changed

  StepReport& operator+=(const StepReport& other) {
    guard += other.guard;
    contacts += other.contacts;
    springs += other.springs;
    search += other.search;
    sweeps += other.sweeps;
    guarding += other.guarding;
    return *this;
  }
};

/// Measures what follows.
class Stopwatch {
 public:
  /// The time since it was made or last asked, s.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace sprung
