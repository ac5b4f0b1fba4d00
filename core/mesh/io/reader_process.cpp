#include "core/mesh/io/reader_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <span>
#include <type_traits>

#include "core/error.h"

namespace sprung {
namespace {

class Writer {
 public:
  template <class Value>
  requires std::is_arithmetic_v<Value>
  void put(const Value& value) { append(&value, sizeof value); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }
  void put(const std::vector<std::byte>& bytes) {
    put(std::uint64_t{bytes.size()});
    append(bytes.data(), bytes.size());
  }
  template <class Scalar, int columns>
  void put(const Eigen::Matrix<Scalar, Eigen::Dynamic, columns, Eigen::RowMajor>& rows) {
    put(static_cast<std::uint64_t>(rows.rows()));
    append(rows.data(), sizeof(Scalar) * std::size_t(rows.size()));
  }
  void put(const Part& part) {
    put(part.name);
    put(part.first_triangle);
    put(part.triangle_count);
    put(part.material);
  }
  void put(const SurfaceMaterial& material) {
    put(material.name);
    for (const float channel : material.color) put(channel);
    put(material.texture);
    put(material.texture_name);
  }
  template <class Item>
  requires(!std::is_arithmetic_v<Item> && !std::is_same_v<Item, std::byte>) void put(const std::vector<Item>& items) {
    put(std::uint64_t{items.size()});
    for (const Item& item : items) put(item);
  }
  std::vector<std::byte> finish() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }

  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class Value>
  requires std::is_arithmetic_v<Value>
  void get(Value& value) { take(&value, sizeof value); }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    value = byte != 0;
  }
  void get(std::string& text) {
    text.resize(take_count(1));
    take(text.data(), text.size());
  }
  void get(std::vector<std::byte>& bytes) {
    bytes.resize(take_count(1));
    take(bytes.data(), bytes.size());
  }
  template <class Scalar, int columns>
  void get(Eigen::Matrix<Scalar, Eigen::Dynamic, columns, Eigen::RowMajor>& rows) {
    rows.resize(take_count(sizeof(Scalar) * columns), columns);
    take(rows.data(), sizeof(Scalar) * std::size_t(rows.size()));
  }
  void get(Part& part) {
    get(part.name);
    get(part.first_triangle);
    get(part.triangle_count);
    get(part.material);
  }
  void get(SurfaceMaterial& material) {
    get(material.name);
    for (float& channel : material.color) get(channel);
    get(material.texture);
    get(material.texture_name);
  }
  template <class Item>
  requires(!std::is_arithmetic_v<Item> && !std::is_same_v<Item, std::byte>) void get(std::vector<Item>& items) {
    items.resize(take_count(sizeof(std::uint64_t)));  // each item begins with the length of a string
    for (Item& item : items) get(item);
  }
  void check_end() const {
    if (!left_.empty()) refuse();
  }

 private:
  [[noreturn]] static void refuse() { throw Error(ErrorKind::kFailed, "the mesh reader returned an incomplete mesh"); }

  std::size_t take_count(std::size_t min_size) {
    std::uint64_t count = 0;
    get(count);
    if (count > left_.size() / min_size) refuse();
    return count;
  }

  void take(void* data, std::size_t size) {
    if (size > left_.size()) refuse();
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_ = left_.subspan(size);
  }

  std::span<const std::byte> left_;
};

/// Visits the fields in the same order for reading and writing.
template <class Visitor, class Mesh>
void visit(Mesh& mesh, const Visitor& field) {
  field(mesh.positions);
  field(mesh.triangles);
  field(mesh.normals);
  field(mesh.uvs);
  field(mesh.colors);
  field(mesh.parts);
  field(mesh.materials);
  field(mesh.notes);
  field(mesh.single_precision);
}

bool covers_triangles(const SurfaceMesh& mesh) {
  std::int64_t next = 0;
  for (const Part& part : mesh.parts) {
    const bool is_known = part.material >= -1 && part.material < std::ssize(mesh.materials);
    if (part.first_triangle != next || part.triangle_count <= 0 || !is_known) return false;
    next += part.triangle_count;
  }
  return next == mesh.triangles.rows();
}

}  // namespace

std::vector<std::byte> bytes_from_mesh(const SurfaceMesh& mesh) {
  Writer writer;
  visit(mesh, [&](const auto& field) { writer.put(field); });
  return writer.finish();
}

SurfaceMesh mesh_from_bytes(std::span<const std::byte> bytes) {
  SurfaceMesh mesh;
  Reader reader(bytes);
  visit(mesh, [&](auto& field) { reader.get(field); });
  reader.check_end();
  return mesh;
}

std::string find_fault(const SurfaceMesh& mesh) {
  const Eigen::Index vertices = mesh.positions.rows();
  for (Eigen::Index v = 0; v < vertices; ++v) {
    if (!mesh.positions.row(v).allFinite()) return fmt::format("vertex {} has a coordinate that is not finite", v + 1);
  }
  if (mesh.triangles.rows() == 0) {
    return vertices > 0 ? fmt::format("no faces (a point cloud); it holds {} points", vertices) : "no faces";
  }
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto row = mesh.triangles.row(t);
    if (row.minCoeff() < 0 || row.maxCoeff() >= vertices) {
      return fmt::format("triangle {} refers to vertex {} of {}, counted from 1 (index out of range)", t + 1,
                         row.minCoeff() < 0 ? row.minCoeff() : row.maxCoeff() + 1L, vertices);
    }
  }
  const auto fits = [&](const auto& rows) { return rows.rows() == 0 || rows.rows() == vertices; };
  if (!fits(mesh.normals) || !fits(mesh.uvs) || !fits(mesh.colors)) return "its normals, UVs or colours do not fit";
  if (!mesh.normals.allFinite() || !mesh.uvs.allFinite() || !mesh.colors.allFinite())
    return "a normal, a UV or a colour is not finite";
  return covers_triangles(mesh) ? "" : "its parts do not cover its triangles";
}

namespace {

using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

constexpr const char* kAdvice =
    "it is damaged or uses a feature that the reader cannot take; open it in a mesh editor "
    "and export it as OBJ, PLY or GLB";

/// The first byte that the child sends; the rest is the mesh or the message.
enum class Reply : char { kMesh = 'M', kError = 'E', kNoMemory = 'N' };

void set_limit(decltype(RLIMIT_AS) resource, rlim_t soft, rlim_t hard) {
  rlimit given{};
  getrlimit(resource, &given);
  const rlimit limit{std::min(soft, given.rlim_max), std::min(hard, given.rlim_max)};
  setrlimit(resource, &limit);
}

/// Bytes of address space in use, to which the limit is added; 0 if unknown.
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit_this_process(const ReadingLimits& limits) {
  const auto cpu_time = static_cast<rlim_t>(limits.cpu_time);
  set_limit(RLIMIT_CPU, cpu_time, cpu_time + 1);
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_FSIZE, 0, 0);
  if (kIsSanitized) return;  // its shadow takes terabytes of addresses
  if (const std::uint64_t used = address_space(); used > 0) {
    set_limit(RLIMIT_AS, used + limits.memory, used + limits.memory);
  }
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

void take_default_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  for (const int signal : {SIGPIPE, SIGXCPU, SIGABRT}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

void write_all(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) _exit(1);
    bytes = bytes.subspan(std::max<ssize_t>(count, 0));
  }
}

void send(int pipe, Reply reply, std::span<const std::byte> bytes) {
  write_all(pipe, std::as_bytes(std::span(&reply, 1)));
  write_all(pipe, bytes);
}

/// Never returns, and runs no destructors of objects from before the fork.
[[noreturn]] void run_child(int pipe, pid_t parent, const ReadingLimits& limits,
                            const std::function<SurfaceMesh()>& read) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  take_default_signals();
  limit_this_process(limits);
  try {
    const std::vector<std::byte> bytes = bytes_from_mesh(read());
    send(pipe, Reply::kMesh, bytes);
  } catch (const std::bad_alloc&) {
    send(pipe, Reply::kNoMemory, {});
  } catch (const std::exception& error) {
    send(pipe, Reply::kError, std::as_bytes(std::span(error.what(), std::strlen(error.what()))));
  }
  _exit(0);
}

/// Owns the running child and our end of its pipe.
class Child {
 public:
  Child(pid_t pid, int pipe) : pid_(pid), pipe_(pipe) {}
  ~Child() {
    close(pipe_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// What it sends until it closes the pipe; nothing if the deadline passes.
  [[nodiscard]] std::optional<std::vector<std::byte>> receive(Clock::time_point deadline) const {
    std::vector<std::byte> bytes;
    std::vector<std::byte> chunk(std::size_t{1} << 20);
    while (wait_for_bytes(deadline)) {
      const ssize_t count = ::read(pipe_, chunk.data(), chunk.size());
      if (count == 0 || (count < 0 && errno != EINTR)) return bytes;
      bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + std::max<ssize_t>(count, 0));
    }
    return std::nullopt;
  }

  /// The status of waitpid; 0 if the child was reaped elsewhere.
  int wait() {
    int status = 0;
    pid_t ended = 0;
    do {
      ended = waitpid(pid_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    pid_ = -1;
    return ended < 0 ? 0 : status;
  }

 private:
  [[nodiscard]] bool wait_for_bytes(Clock::time_point deadline) const {
    pollfd waiting{.fd = pipe_, .events = POLLIN, .revents = 0};
    while (true) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      if (left <= 0) return false;
      const int ready = poll(&waiting, 1, int(std::min<long>(left, 1000)));
      if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
    }
  }

  pid_t pid_;
  int pipe_;
};

class Reading {
 public:
  Reading(const std::filesystem::path& file, const ReadingLimits& limits) : file_(file), limits_(limits) {}

  SurfaceMesh run(const std::function<SurfaceMesh()>& read) const {
    std::array<int, 2> pipe{};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0) refuse_start();
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid == 0) run_child(pipe[1], parent, limits_, read);
    const int error = errno;
    close(pipe[1]);
    Child child(pid, pipe[0]);
    errno = error;
    if (pid < 0) refuse_start();
    const auto bytes = child.receive(Clock::now() + std::chrono::seconds(limits_.wall_time));
    if (!bytes) refuse(fmt::format("gave up reading it after {} s; {}", limits_.wall_time, kAdvice));
    check_end(child.wait());
    return open_reply(*bytes);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file_.string(), reason));
  }

  [[noreturn]] void refuse_start() const {
    throw Error(ErrorKind::kFailed,
                fmt::format("{}: cannot start a process to read it: {}", file_.string(), std::strerror(errno)));
  }

  void check_end(int status) const {
    if (WIFSIGNALED(status)) refuse_signal(WTERMSIG(status));
    if (WEXITSTATUS(status) != 0) refuse(fmt::format("the reader crashed on this file; {}", kAdvice));
  }

  [[noreturn]] void refuse_signal(int signal) const {
    const char* known = sigabbrev_np(signal);
    const std::string name = known == nullptr ? std::to_string(signal) : fmt::format("SIG{}", known);
    if (signal == SIGXCPU)
      refuse(fmt::format("gave up reading it after {} s of computing; {}", limits_.cpu_time, kAdvice));
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGKILL) {
      throw Error(ErrorKind::kFailed, fmt::format("{}: reading it was stopped by {}", file_.string(), name));
    }
    refuse(fmt::format("the reader crashed on this file (signal {}); {}", name, kAdvice));
  }

  [[nodiscard]] SurfaceMesh open_reply(std::span<const std::byte> bytes) const {
    if (bytes.empty()) refuse(fmt::format("the reader gave no answer; {}", kAdvice));
    const auto reply = static_cast<Reply>(bytes[0]);
    bytes = bytes.subspan(1);
    if (reply == Reply::kMesh) return mesh_from_bytes(bytes);
    if (reply == Reply::kNoMemory) {
      refuse(fmt::format("reading it takes more than {} MB of memory, too much for a file of its size; {}",
                         limits_.memory >> 20, kAdvice));
    }
    throw Error(ErrorKind::kBadInput, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }

  const std::filesystem::path& file_;
  const ReadingLimits& limits_;
};

}  // namespace

SurfaceMesh read_in_child(const std::filesystem::path& file, const ReadingLimits& limits,
                          const std::function<SurfaceMesh()>& read) {
  return Reading(file, limits).run(read);
}

}  // namespace sprung
