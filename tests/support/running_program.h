#pragma once
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "tests/support/run_program.h"

namespace sprung {

/// build/.../sprung running in a folder, with these words; its messages go to program.err there.
class RunningProgram {
 public:
  RunningProgram(const TempFolder& folder, std::vector<std::string> words) : folder_(folder) {
    words.insert(words.begin(), SPRUNG_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ != 0) return;
    const int err = open((folder.path() / "program.err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (chdir(folder.path().c_str()) != 0 || dup2(err, 2) < 0 || dup2(err, 1) < 0) _exit(99);
    execv(argv[0], argv.data());
    _exit(99);
  }
  ~RunningProgram() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Waits until holds() is true. False if it is not by the time the program ends, or within two minutes.
  template <class Condition>
  [[nodiscard]] bool wait_until(const Condition& holds) const {
    constexpr int kLooks = 120000;
    for (int look = 0; look < kLooks; ++look) {
      const bool has_ended = this->has_ended();
      if (holds()) return true;
      if (has_ended) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  [[nodiscard]] bool wait_for(const std::filesystem::path& file) const {
    return wait_until([&file] { return std::filesystem::exists(file); });
  }

  void signal(int number) const { kill(process_, number); }

  /// How it ended: the exit code, -1 by a signal.
  [[nodiscard]] ProgramRun wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .out = "",
            .err = text_of(folder_.path() / "program.err")};
  }

 private:
  [[nodiscard]] bool has_ended() const {
    siginfo_t info{};
    return waitid(P_PID, id_t(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
  }

  const TempFolder& folder_;
  pid_t process_ = -1;
};

}  // namespace sprung
