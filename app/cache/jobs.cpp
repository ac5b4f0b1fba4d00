#include "app/cache/jobs.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <vector>

#include "app/interrupt.h"
#include "app/progress.h"
#include "core/count_of.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr useconds_t kPause = 50000;  // between looks at the processes

using Work = std::function<void(const FrameRange& part, const Console& console)>;

struct Job {
  FrameRange part;
  pid_t process = -1;
  bool is_running = true;
  bool has_failed = false;
};

std::vector<Job> divide(const FrameRange& range, int jobs) {
  std::vector<Job> parts;
  const int count = std::min(jobs, range.count());
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int cut) {
      return range.first + static_cast<int>(static_cast<long>(range.count()) * cut / count);
    };
    parts.push_back({.part = {.first = at(i), .last = at(i + 1) - 1}});
  }
  return parts;
}

/// Never returns: what the process inherited is not its own to clean up.
[[noreturn]] void run_here(const Job& job, Console console, const Work& work) {
  console.quiet = true;
  console.is_terminal = false;
  int code = 0;
  try {
    work(job.part, console);
  } catch (const Interrupted&) {
    code = kInterruptedExitCode;
  } catch (const std::exception& error) {
    console.error(fmt::format("frames {}:{}: {}", job.part.first, job.part.last, error.what()));
    code = static_cast<int>(ErrorKind::kFailed);
  }
  std::fflush(nullptr);
  _exit(code);
}

void start(Job& job, const Console& console, const Work& work) {
  job.process = fork();
  if (job.process == 0) run_here(job, console, work);
  if (job.process < 0) throw Error(ErrorKind::kFailed, "cannot start another process");
}

void look_after(Job& job) {
  int status = 0;
  if (!job.is_running || waitpid(job.process, &status, WNOHANG) != job.process) return;
  job.is_running = false;
  job.has_failed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

void wait_for_all(std::vector<Job>& jobs) {
  bool is_told = false;
  while (std::any_of(jobs.begin(), jobs.end(), [](const Job& job) { return job.is_running; })) {
    for (Job& job : jobs) look_after(job);
    if (is_interrupted() && !is_told) {
      for (const Job& job : jobs) {
        if (job.is_running) kill(job.process, SIGTERM);
      }
      is_told = true;
    }
    usleep(kPause);
  }
}

}  // namespace

void run_jobs(const FrameRange& range, int jobs, const Console& console, const Work& work) {
  if (jobs <= 1) return work(range, console);
  std::fflush(nullptr);
  Progress progress(console, "render");
  std::vector<Job> parts = divide(range, jobs);
  for (Job& job : parts) start(job, console, work);
  wait_for_all(parts);
  stop_if_interrupted();
  std::string failed;
  for (const Job& job : parts) {
    if (job.has_failed) failed += fmt::format("{}{}:{}", failed.empty() ? "" : ", ", job.part.first, job.part.last);
  }
  if (!failed.empty()) {
    throw Error(ErrorKind::kFailed, fmt::format("these frames were not all drawn: {}; the others are", failed));
  }
  progress.finish(fmt::format("{} by {}", count_of(range.count(), "picture"),
                              count_of(static_cast<long>(parts.size()), "process", "processes")));
}

}  // namespace sprung
