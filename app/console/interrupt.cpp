#include "app/console/interrupt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

#include "core/error.h"
#include "core/files.h"
#include "core/io/process.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr auto kGrace = std::chrono::milliseconds(330);
constexpr int kTimeIsUp = -1;

/// Why the work has to stop: the number of the first signal, or kTimeIsUp; 0: it need not.
std::atomic<int> cause{0};
static_assert(decltype(cause)::is_always_lock_free);  // as signal handlers require

sem_t is_caused;        // posted with it
double time_limit = 0;  // s; set before its watch starts

void stop_because_of(int why) {
  int none = 0;
  if (cause.compare_exchange_strong(none, why)) sem_post(&is_caused);
}

extern "C" void on_interrupt(int signal) { stop_because_of(signal); }

/// Waits for a reason to stop and gives the work the time to do so. A thread that holds the lock of stderr then may
/// never release it.
void end_what_does_not_stop(const Console& console) {
  while (sem_wait(&is_caused) != 0) {
  }
  std::this_thread::sleep_for(kGrace);
  kill_child_processes();  // which might still be writing them
  remove_unfinished_files();
  if (ftrylockfile(stderr) == 0) {
    report_interruption(console);
    std::fflush(stderr);
  }
  _exit(interrupted_exit_code());
}

}  // namespace

void catch_interrupts(const Console& console) {
  sem_init(&is_caused, 0, 0);
  std::thread([&console] { end_what_does_not_stop(console); }).detach();
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

void limit_time(double seconds) {
  time_limit = seconds;
  std::thread([seconds] {
    constexpr double kForever = 1e9;  // s; more than that is no time_t in nanoseconds
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(seconds, kForever)));
    stop_because_of(kTimeIsUp);
  }).detach();
}

bool is_interrupted() { return cause != 0; }

int interrupted_exit_code() { return cause == kTimeIsUp ? int(ErrorKind::kFailed) : 128 + cause; }

void report_interruption(const Console& console) {
  if (cause == kTimeIsUp) {
    console.error(
        fmt::format("stopped after {}, the limit set by --time-limit", readable(time_limit, Dimension::kTime)));
  } else {
    console.warn("interrupted");
  }
}

void stop_if_interrupted() {
  if (is_interrupted()) throw Interrupted{};
}

void reserve_standard_files() {
  for (const int file : std::array{STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(file, F_GETFD) != -1 || errno != EBADF) continue;
    static_cast<void>(open("/dev/null", file == STDERR_FILENO ? O_WRONLY : O_RDONLY));  // takes the lowest number
  }
}

void flush_results() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw Error(ErrorKind::kFailed, fmt::format("cannot write the results to stdout: {}", std::strerror(errno)));
}

}  // namespace sprung
