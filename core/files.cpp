#include "core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_reading(const fs::path& file, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file.string(), reason));
}

[[noreturn]] void fail_writing(const fs::path& file, const std::string& reason) {
  throw Error(ErrorKind::kFailed, fmt::format("cannot write '{}': {}", file.string(), reason));
}

/// "; did you mean 'bear.ply'?" if the folder holds a file of a similar name.
std::string suggest_file(const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder, error)) return fmt::format("; there is no folder '{}'", folder.string());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());  // the order of a directory is unspecified
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string_view nearest = nearest_word(file.filename().string(), known);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

/// The missing folders above a file, innermost first.
std::vector<fs::path> missing_folders(fs::path folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (; !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) {
    missing.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  return missing;
}

/// The error number of an attempt to write a file under its temporary name; 0: it worked.
int try_to_write(const fs::path& file) {
  const fs::path trial = PartialFile::temporary_name(file);
  if (std::FILE* existing = std::fopen(trial.c_str(), "rb")) {  // left by a run that was killed; will be replaced
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

/// False also on file systems without locks.
bool is_locked_elsewhere(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }

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

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_readable(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::status_known(status)) refuse_reading(file, error.message());
  if (!fs::exists(status)) refuse_reading(file, "no such file" + suggest_file(file));
  if (fs::is_directory(status)) refuse_reading(file, "is a directory, not a file");
  if (!fs::is_regular_file(status)) refuse_reading(file, "is a pipe or a device, not a regular file");
  if (!std::ifstream(file)) refuse_reading(file, "cannot be opened for reading; check its permissions");
}

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) refuse_reading(file, error.message());
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream.gcount() != std::ssize(bytes)) refuse_reading(file, "cannot be read to its end");
  return bytes;
}

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
  const std::vector<fs::path> created = missing_folders(folder);
  const auto clean_up = [&] {
    std::error_code ignored;
    for (const fs::path& empty : created) fs::remove(empty, ignored);
  };
  try {
    make_folder(folder);
  } catch (...) {
    clean_up();
    throw;
  }
  const int reason = try_to_write(file);
  clean_up();
  if (reason != 0) fail_writing(file, std::strerror(reason));
}

namespace {

/// The temporary names of all PartialFiles that are neither published nor gone.
struct UnfinishedFiles {
  std::mutex mutex;
  std::multiset<fs::path> names;

  static UnfinishedFiles& of_process() {
    static UnfinishedFiles& all = *new UnfinishedFiles;  // never destroyed: threads may outlive main()
    return all;
  }
};

}  // namespace

PartialFile::PartialFile(fs::path file) : PartialFile(file, temporary_name(file)) {}

PartialFile::PartialFile(fs::path file, fs::path temporary) : file_(std::move(file)), temporary_(std::move(temporary)) {
  UnfinishedFiles& all = UnfinishedFiles::of_process();
  const std::lock_guard lock(all.mutex);
  all.names.insert(temporary_);
}

PartialFile::~PartialFile() {
  if (is_published_) return;
  UnfinishedFiles& all = UnfinishedFiles::of_process();
  const std::lock_guard lock(all.mutex);
  all.names.erase(all.names.find(temporary_));
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void PartialFile::publish() {
  UnfinishedFiles& all = UnfinishedFiles::of_process();
  const std::lock_guard lock(all.mutex);
  std::error_code error;
  fs::rename(temporary_, file_, error);
  if (error) fail_writing(file_, error.message());
  all.names.erase(all.names.find(temporary_));
  is_published_ = true;
}

void remove_unfinished_files() {
  UnfinishedFiles& all = UnfinishedFiles::of_process();
  all.mutex.lock();  // for good
  std::error_code ignored;
  for (const fs::path& name : all.names) fs::remove(name, ignored);
}

void write_file(const fs::path& file, std::string_view bytes) { write_file(file, {bytes}); }

void write_file(const fs::path& file, std::initializer_list<std::string_view> pieces) {
  PartialFile partial(file);
  errno = 0;
  std::ofstream out(partial.path(), std::ios::binary);
  for (const std::string_view piece : pieces) out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  out.close();
  if (!out) fail_writing(file, errno != 0 ? std::strerror(errno) : "no reason given");
  partial.publish();
}

FileLock::FileLock(const fs::path& file)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {  // less the umask
  if (descriptor_ < 0) fail_writing(file, std::strerror(errno));
  if (is_locked_elsewhere(descriptor_)) {
    ::close(descriptor_);
    refuse_second_run(file);
  }
}

FileLock::~FileLock() { ::close(descriptor_); }

bool FileLock::is_of(const fs::path& file) const {
  struct stat here {};
  struct stat there {};
  if (::fstat(descriptor_, &here) != 0 || ::stat(file.c_str(), &there) != 0) return false;
  return here.st_ino == there.st_ino && here.st_dev == there.st_dev;
}

bool is_being_written(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_locked = is_locked_elsewhere(descriptor);
  ::close(descriptor);
  return is_locked;
}

void refuse_second_run(const fs::path& file) {
  throw Error(ErrorKind::kFailed, fmt::format("'{}' is being written by another run", file.string()));
}

fs::path NumberedName::file(int number) const {
  return folder / fmt::format("{}{:0{}}{}", before, number, digits, after);
}

namespace {

/// With the only run of # in the file name as the number.
std::string with_hashes_as_braces(std::string_view text) {
  const auto name = text.rfind('/') + 1;  // 0 if there is no folder
  const auto open = text.find('#', name);
  if (open == std::string_view::npos || has_number(text)) return std::string(text);
  const auto end = std::min(text.find_first_not_of('#', open), text.size());
  if (text.find('#', end) != std::string_view::npos) return std::string(text);
  return fmt::format("{}{{:0{}}}{}", text.substr(0, open), end - open, text.substr(end));
}

}  // namespace

std::string with_braces(std::string_view text) {
  const auto open = text.find('%');
  const auto end = std::min(text.find_first_not_of("0123456789", open + 1), text.size());
  if (open == std::string_view::npos || end == text.size() || text[end] != 'd') return with_hashes_as_braces(text);
  const std::string_view digits = text.substr(open + 1, end - open - 1);
  return fmt::format("{}{{{}{}}}{}", text.substr(0, open), digits.empty() ? "" : ":", digits, text.substr(end + 1));
}

bool has_number(std::string_view text) { return text.find_first_of("{}") != std::string_view::npos; }

NumberedName parse_numbered_name(std::string_view text, std::string_view examples) {
  const auto refuse = [&](std::string_view reason) {
    throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", text, reason, examples));
  };
  const fs::path path(text);
  const std::string name = path.filename().string();
  const auto open = name.find('{');
  const auto close = name.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    refuse("the placeholder for the number must be in the file name");
  }
  NumberedName numbered{.folder = path.parent_path(), .before = name.substr(0, open), .after = name.substr(close + 1)};
  numbered.digits = digits_of(std::string_view(name).substr(open + 1, close - open - 1));
  if (numbered.digits < 0) refuse("the placeholder for the number must look like {:04}");
  if (has_number(numbered.after)) refuse("a file name has exactly one placeholder");
  return numbered;
}

std::uint64_t hash_of(std::span<const std::byte> bytes, std::uint64_t hash) {
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
  return hash;
}

std::string file_hash(const fs::path& file) {
  std::ifstream bytes(file, std::ios::binary);
  std::uint64_t hash = hash_of({});
  std::vector<char> block(1 << 20);
  while (bytes.read(block.data(), static_cast<std::streamsize>(block.size())) || bytes.gcount() > 0) {
    hash = hash_of(std::as_bytes(std::span(block.data(), bytes.gcount())), hash);
  }
  return fmt::format("{:016x}", hash);
}

std::string build_of_this_program() { return file_hash("/proc/self/exe"); }

}  // namespace sprung
