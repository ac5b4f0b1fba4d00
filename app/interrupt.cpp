#include "app/interrupt.h"

#include <array>
#include <csignal>

namespace sprung {
namespace {

volatile std::sig_atomic_t interrupted_by = 0;

extern "C" void on_interrupt(int signal) {
  interrupted_by = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted() { return interrupted_by != 0; }

int interrupted_exit_code() { return 128 + interrupted_by; }

void stop_if_interrupted() {
  if (is_interrupted()) throw Interrupted{};
}

}  // namespace sprung
