#include "core/io/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

#include "core/error.h"

namespace sprung {

namespace {

constexpr int kPipeSize = 1 << 20;    // bytes; an image in few writes
constexpr off_t kErrorOutput = 2000;  // bytes

/// Suppresses SIGPIPE in this thread: writing to a broken pipe fails with EPIPE.
class SigpipeBlocker {
 public:
  SigpipeBlocker() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~SigpipeBlocker() {
    const timespec now{};
    if (!was_pending_) {
      while (sigtimedwait(&pipe_, nullptr, &now) == -1 && errno == EINTR) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SigpipeBlocker(const SigpipeBlocker&) = delete;
  SigpipeBlocker& operator=(const SigpipeBlocker&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

/// A file in memory for the standard error of the child: unlike a pipe it never fills up, and it needs no folder.
int open_messages() { return memfd_create("sprung_messages", MFD_CLOEXEC); }

/// Returns 0 or an error number.
int spawn(const std::vector<std::string>& arguments, int input, ChildProcess::Output output, int messages, pid_t& pid) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  if (output == ChildProcess::Output::kNone) {
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  posix_spawn_file_actions_adddup2(&files, messages, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error = posix_spawnp(&pid, argv[0], &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

/// Those that run.
struct RunningChildren {
  std::mutex mutex;
  std::set<pid_t> pids;

  static RunningChildren& of_process() {
    static RunningChildren& all = *new RunningChildren;  // never destroyed: threads may outlive main()
    return all;
  }
};

}  // namespace

void kill_child_processes() {
  RunningChildren& all = RunningChildren::of_process();
  all.mutex.lock();  // for good
  for (const pid_t pid : all.pids) kill(pid, SIGKILL);
  for (const pid_t pid : all.pids) waitpid(pid, nullptr, 0);
}

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, Output output) {
  const auto fail = [&](int error) {
    throw Error(ErrorKind::kFailed, "cannot start " + arguments.front() + ": " + std::strerror(error));
  };
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) fail(errno);
  messages_ = open_messages();
  RunningChildren& all = RunningChildren::of_process();
  const std::lock_guard lock(all.mutex);
  const int error = messages_ < 0 ? errno : spawn(arguments, pipe[0], output, messages_, pid_);
  if (error == 0) all.pids.insert(pid_);
  close(pipe[0]);
  if (error != 0) {
    close(pipe[1]);
    if (messages_ >= 0) close(messages_);
    fail(error);
  }
  input_ = pipe[1];
  fcntl(input_, F_SETPIPE_SZ, kPipeSize);  // may fail
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    finish();
  }
  close(messages_);
}

bool ChildProcess::write(std::span<const std::byte> data) {
  const SigpipeBlocker blocker;
  while (!data.empty()) {
    const ssize_t count = ::write(input_, data.data(), data.size());
    if (count >= 0) {
      data = data.subspan(count);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

int ChildProcess::finish() {
  if (input_ >= 0) close(std::exchange(input_, -1));
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  RunningChildren& all = RunningChildren::of_process();
  const std::lock_guard lock(all.mutex);
  all.pids.erase(std::exchange(pid_, -1));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string ChildProcess::error_output() const {
  const off_t size = lseek(messages_, 0, SEEK_END);
  std::string text(std::clamp<off_t>(size, 0, kErrorOutput), '\0');
  const ssize_t count = pread(messages_, text.data(), text.size(), std::max<off_t>(size - kErrorOutput, 0));
  text.resize(std::max<ssize_t>(count, 0));
  const std::size_t first = text.find_first_not_of(" \r\n\t");
  if (first == std::string::npos) return "no error output";
  return text.substr(first, text.find_last_not_of(" \r\n\t") - first + 1);
}

}  // namespace sprung
