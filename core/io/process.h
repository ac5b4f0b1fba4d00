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

/// The full path of a program by its name, as a shell would find it.
[[nodiscard]] std::optional<std::filesystem::path> find_program(std::string_view name);

/// A running program whose standard input we write. It has its own process group, so Ctrl-C in a terminal does not
/// reach it. What it says on standard error is kept.
class ChildProcess {
 public:
  /// `arguments` begin with the program. Throws Error(kFailed) where it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  /// Kills the program if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// False where the program no longer reads. Never raises SIGPIPE.
  [[nodiscard]] bool write(std::span<const std::byte> data);
  /// Closes the pipe and waits; the exit status, 128 + signal where a signal ended it.
  int finish();
  /// The end of what it said on standard error so far, without surrounding blanks.
  [[nodiscard]] std::string last_words() const;

 private:
  int input_ = -1;
  int messages_ = -1;
  pid_t pid_ = -1;
};

}  // namespace sprung
