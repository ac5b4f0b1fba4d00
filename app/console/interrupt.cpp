#include "app/console/interrupt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "core/error.h"

namespace sprung {
namespace {

/// ns; some senders signal both a process and its group and mean it once.
constexpr std::int64_t kSameSignal = 300000000;

/// Of the first signal, ns; 0: there was none. Several threads may have one each at the same time.
std::atomic<std::int64_t> first_time{0};
static_assert(decltype(first_time)::is_always_lock_free);  // as handlers of signals need it

/// A second signal, meant as such, ends the program at once.
extern "C" void on_interrupt(int /*signal*/) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = std::int64_t{1000000000} * time.tv_sec + time.tv_nsec;
  std::int64_t first = 0;
  if (!first_time.compare_exchange_strong(first, now) && now - first > kSameSignal) _exit(kInterruptedExitCode);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted() { return first_time != 0; }

void stop_if_interrupted() {
  if (is_interrupted()) throw Interrupted{};
}

void hold_standard_files() {
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
