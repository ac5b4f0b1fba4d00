#include "app/film/drawing_processes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "app/console/interrupt.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr int kPipeSize = 1 << 20;  // bytes; the most that Linux grants by default

enum class Message : std::int32_t { kPicture, kDone, kError };

/// Precedes the pixels of a picture, or the text of an error.
struct Header {
  Message kind = Message::kDone;
  ErrorKind error = ErrorKind::kFailed;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::uint64_t bytes = 0;
  std::uint64_t alpha = 0;  // bytes of it, after these
};

void write_all(int pipe, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t done = write(pipe, bytes, size);
    if (done < 0 && errno == EINTR) {
      stop_if_interrupted();
      continue;
    }
    if (done <= 0) throw Interrupted{};  // the parent has gone
    bytes += done;
    size -= std::size_t(done);
  }
}

/// False at the end of the file.
bool read_all(int pipe, void* data, std::size_t size) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t done = read(pipe, bytes, size);
    if (done < 0 && errno == EINTR) {
      stop_if_interrupted();
      continue;
    }
    if (done <= 0) return false;
    bytes += done;
    size -= std::size_t(done);
  }
  return true;
}

void send_error(int pipe, ErrorKind kind, const std::string& text) {
  const Header header{.kind = Message::kError, .error = kind, .bytes = text.size()};
  write_all(pipe, &header, sizeof header);
  write_all(pipe, text.data(), text.size());
}

void work_and_send(int pipe, std::size_t number, const DrawingProcesses::Work& work) {
  try {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    work(number, [pipe](const Image& image) {
      const Header header{.kind = Message::kPicture,
                          .width = image.width,
                          .height = image.height,
                          .bytes = image.pixels.size(),
                          .alpha = image.alpha.size()};
      write_all(pipe, &header, sizeof header);
      write_all(pipe, image.pixels.data(), image.pixels.size());
      write_all(pipe, image.alpha.data(), image.alpha.size());
    });
    const Header done;
    write_all(pipe, &done, sizeof done);
  } catch (const Error& error) {
    send_error(pipe, error.kind(), error.what());
  } catch (const std::exception& error) {
    send_error(pipe, ErrorKind::kFailed, error.what());
  }
}

/// Never returns: the child must not clean up what it inherited.
[[noreturn]] void run_here(int pipe, std::size_t number, const DrawingProcesses::Work& work) {
  try {
    work_and_send(pipe, number, work);
  } catch (const Interrupted&) {
    _exit(interrupted_exit_code());
  }
  std::fflush(nullptr);
  _exit(0);
}

std::string end_of(pid_t process) {
  siginfo_t info{};
  if (waitid(P_PID, id_t(process), &info, WEXITED | WNOWAIT) != 0) return "was lost";
  return info.si_code == CLD_EXITED ? "ended early" : fmt::format("was ended by signal {}", info.si_status);
}

}  // namespace

DrawingProcesses::DrawingProcesses(std::size_t count, const Work& work) {
  try {
    for (std::size_t i = 0; i < count; ++i) start(i, work);
  } catch (...) {
    stop();
    throw;
  }
}

DrawingProcesses::~DrawingProcesses() { stop(); }

void DrawingProcesses::start(std::size_t number, const Work& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(ErrorKind::kFailed, "cannot create a pipe to a drawing process");
  fcntl(ends[1], F_SETPIPE_SZ, kPipeSize);
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    // Otherwise no child would notice that this process no longer reads.
    for (const Child& other : children_) close(other.pipe);
    run_here(ends[1], number, work);
  }
  close(ends[1]);
  children_.push_back({ends[0], process});
  if (process < 0) throw Error(ErrorKind::kFailed, "cannot start a drawing process; --jobs 1 needs none");
}

void DrawingProcesses::stop() {
  for (const Child& child : children_) close(child.pipe);
  interrupt();
  for (const Child& child : children_) {
    if (child.process >= 0) waitpid(child.process, nullptr, 0);
  }
}

void DrawingProcesses::interrupt() const {
  for (const Child& child : children_) {
    if (child.process >= 0) kill(child.process, SIGTERM);
  }
}

std::optional<Image> DrawingProcesses::receive(std::size_t process) {
  Child& child = children_[process];
  Header header;
  if (!read_all(child.pipe, &header, sizeof header)) {
    stop_if_interrupted();
    throw Error(ErrorKind::kFailed,
                fmt::format("a drawing process {}; --jobs 1 needs none and less memory", end_of(child.process)));
  }
  if (header.kind == Message::kError) {
    std::string text(header.bytes, ' ');
    read_all(child.pipe, text.data(), text.size());
    throw Error(header.error, text);
  }
  if (header.kind == Message::kDone) {
    child.is_done = true;
    return std::nullopt;
  }
  Image image;
  image.width = header.width;
  image.height = header.height;
  image.pixels.resize(header.bytes);
  image.alpha.resize(header.alpha);
  if (!read_all(child.pipe, image.pixels.data(), image.pixels.size()) ||
      !read_all(child.pipe, image.alpha.data(), image.alpha.size())) {
    stop_if_interrupted();
    throw Error(ErrorKind::kFailed, "a drawing process ended in the middle of a picture");
  }
  return image;
}

void DrawingProcesses::finish() {
  for (std::size_t i = 0; i < children_.size(); ++i) {
    while (!children_[i].is_done) static_cast<void>(receive(i));
  }
}

bool end_worker_threads() {
  tbb::task_scheduler_handle workers{tbb::attach{}};
  return tbb::finalize(workers, std::nothrow);
}

}  // namespace sprung
