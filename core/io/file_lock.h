#pragma once
#include <filesystem>

namespace sprung {

/// Keeps other runs from writing a file while it lives; the system gives the lock back even where a run is killed.
class FileLock {
 public:
  /// Makes the file where there is none. Throws Error(kFailed) where it cannot be written or another run writes it.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// True where the file of that name is the one locked.
  [[nodiscard]] bool is_of(const std::filesystem::path& file) const;

 private:
  int descriptor_;
};

/// True while a FileLock of any process holds it.
[[nodiscard]] bool is_being_written(const std::filesystem::path& file);

/// Throws Error(kFailed): another run writes that file.
[[noreturn]] void refuse_second_run(const std::filesystem::path& file);

}  // namespace sprung
