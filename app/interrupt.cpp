#include "app/interrupt.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <ctime>

namespace sprung {
namespace {

constexpr double kSameSignal = 0.3;  // s: some senders signal both a process and its group and mean it once

volatile std::sig_atomic_t interrupted = 0;
timespec first_time{};  // of the signal; written and read by the handler alone

double seconds(const timespec& from, const timespec& to) {
  return static_cast<double>(to.tv_sec - from.tv_sec) + 1e-9 * static_cast<double>(to.tv_nsec - from.tv_nsec);
}

/// A second signal, meant as such, ends the program at once.
extern "C" void on_interrupt(int /*signal*/) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted == 0) {
    interrupted = 1;
    first_time = now;
  } else if (seconds(first_time, now) > kSameSignal) {
    _exit(kInterruptedExitCode);
  }
}

}  // namespace

void catch_interrupts() {
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted() { return interrupted != 0; }

void stop_if_interrupted() {
  if (is_interrupted()) throw Interrupted{};
}

}  // namespace sprung
