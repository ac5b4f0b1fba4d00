#include "app/writable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/error.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// The folders above a file that are not there yet, the lowest first.
std::vector<fs::path> missing_folders(fs::path folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (; !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) {
    missing.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  return missing;
}

/// Why a new file beside this one cannot be written; 0: it can.
int write_beside(const fs::path& file) {
  fs::path trial = file;
  trial += ".partial";
  if (std::FILE* existing = std::fopen(trial.c_str(), "rb")) {  // of a run that was killed; it will be replaced
    std::fclose(existing);
    return 0;
  }
  std::FILE* out = std::fopen(trial.c_str(), "wb");
  if (out == nullptr) return errno;
  const bool is_written = std::fputc('x', out) != EOF;
  const int write_error = errno;
  const bool is_closed = std::fclose(out) == 0;
  const int close_error = errno;
  std::remove(trial.c_str());
  if (!is_written) return write_error;
  return is_closed ? 0 : close_error;
}

}  // namespace

void make_folder(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) return;
  throw Error(ErrorKind::kFailed, fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

void check_writable(const fs::path& file) {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  const std::vector<fs::path> made = missing_folders(folder);
  const auto clean_up = [&] {
    std::error_code ignored;
    for (const fs::path& empty : made) fs::remove(empty, ignored);
  };
  try {
    make_folder(folder);
  } catch (...) {
    clean_up();
    throw;
  }
  const int reason = write_beside(file);
  clean_up();
  if (reason == 0) return;
  throw Error(ErrorKind::kFailed, fmt::format("cannot write '{}': {}", file.string(), std::strerror(reason)));
}

}  // namespace sprung
