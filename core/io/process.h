#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// The path of a program as a shell would find it; nothing if it is not on PATH.
[[nodiscard]] std::optional<std::filesystem::path> find_program(std::string_view name);

/// A running program that reads from us on its standard input. It has its own process group, so Ctrl-C in a terminal
/// does not reach it. Its standard error is kept.
class ChildProcess {
 public:
  enum class Output { kNone, kOurs };  // where its standard output goes

  /// `arguments` begin with the program. Throws Error(kFailed) if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& arguments, Output output = Output::kNone);
  /// Kills the program if it is still running.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// False once the program no longer reads. Never raises SIGPIPE.
  [[nodiscard]] bool write(std::span<const std::byte> data);
  /// Closes the pipe and waits; the exit status, or 128 + the signal that ended it.
  int finish();
  /// The end of its standard error so far, trimmed.
  [[nodiscard]] std::string error_output() const;

 private:
  int input_ = -1;
  int messages_ = -1;
  pid_t pid_ = -1;
};

/// Kills all of them, from a process that is about to end without their destructors; none is started from then on.
void kill_child_processes();

}  // namespace sprung
