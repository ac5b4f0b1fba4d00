#include "core/io/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
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

namespace {

/// The number of digits in "{:04}", "{:04d}", "{:4}", "{}", "{:d}"; -1 for anything else.
int digits_of(std::string_view inside) {
  if (inside.starts_with(':')) inside.remove_prefix(1);
  if (inside.ends_with('d')) inside.remove_suffix(1);
  if (inside.empty()) return 0;
  const bool is_number = std::all_of(inside.begin(), inside.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int digits = is_number && inside.size() <= 2 ? std::stoi(std::string(inside)) : -1;
  return digits > 9 ? -1 : digits;
}

}  // namespace

std::filesystem::path NumberedName::file(int number) const {
  return folder / fmt::format("{}{:0{}}{}", before, number, digits, after);
}

bool has_number(std::string_view words) { return words.find_first_of("{}") != std::string_view::npos; }

NumberedName parse_numbered_name(std::string_view words, std::string_view examples) {
  const auto refuse = [&](std::string_view reason) {
    throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", words, reason, examples));
  };
  const std::filesystem::path path(words);
  const std::string name = path.filename().string();
  const auto open = name.find('{');
  const auto close = name.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    refuse("the number's place must stand in the file's name");
  }
  NumberedName numbered{.folder = path.parent_path(), .before = name.substr(0, open), .after = name.substr(close + 1)};
  numbered.digits = digits_of(std::string_view(name).substr(open + 1, close - open - 1));
  if (numbered.digits < 0) refuse("the number's place must look like {:04}");
  if (has_number(numbered.after)) refuse("a name has one number");
  return numbered;
}

void write_whole_file(const std::filesystem::path& file, std::string_view text) {
  std::filesystem::path partial = file;
  partial += ".partial";
  const auto fail = [&](const std::string& reason) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw Error(ErrorKind::kFailed, file.string() + ": cannot write the file: " + reason);
  };
  errno = 0;
  std::ofstream out(partial, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail(errno != 0 ? std::strerror(errno) : "no reason given");
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) fail(error.message());
}

std::string file_hash(const std::filesystem::path& file) {
  std::ifstream bytes(file, std::ios::binary);
  std::uint64_t hash = 0xcbf29ce484222325U;
  std::vector<char> block(1 << 20);
  while (bytes.read(block.data(), static_cast<std::streamsize>(block.size())) || bytes.gcount() > 0) {
    for (const char byte : std::span(block.data(), bytes.gcount())) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
  }
  return fmt::format("{:016x}", hash);
}

std::string build_of_this_program() { return file_hash("/proc/self/exe"); }

}  // namespace sprung
