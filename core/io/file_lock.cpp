#include "core/io/file_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace sprung {
namespace {

constexpr int kForAll = 0666;  // but for what the umask takes away

/// False as well where the file system knows no locks.
bool is_locked_elsewhere(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }

}  // namespace

FileLock::FileLock(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kForAll)) {
  if (descriptor_ < 0) {
    throw Error(ErrorKind::kFailed, fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
  }
  if (is_locked_elsewhere(descriptor_)) {
    ::close(descriptor_);
    refuse_second_run(file);
  }
}

FileLock::~FileLock() { ::close(descriptor_); }

bool FileLock::is_of(const std::filesystem::path& file) const {
  struct stat here {};
  struct stat there {};
  if (::fstat(descriptor_, &here) != 0 || ::stat(file.c_str(), &there) != 0) return false;
  return here.st_ino == there.st_ino && here.st_dev == there.st_dev;
}

bool is_being_written(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_locked = is_locked_elsewhere(descriptor);
  ::close(descriptor);
  return is_locked;
}

void refuse_second_run(const std::filesystem::path& file) {
  throw Error(ErrorKind::kFailed, fmt::format("'{}' is being written by another run", file.string()));
}

}  // namespace sprung
