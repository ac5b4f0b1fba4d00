#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace sprung {

/// The extension of a file name in lower case: ".obj".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

/// Throws Error(kBadInput), naming file and reason, unless this is a regular file that can be opened for reading.
void check_readable(const std::filesystem::path& file);

/// The contents of a file. Throws Error(kBadInput).
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Creates a folder and its parents. Throws Error(kFailed) naming it and the reason.
void make_folder(const std::filesystem::path& folder);

/// Tests whether a file can be written, missing folders included, and leaves nothing behind. Throws Error(kFailed)
/// naming the folder or the file and the reason.
void check_writable(const std::filesystem::path& file);

/// A file that is written under a temporary name beside its own and renamed once it is complete, so that a file under
/// its own name is never half written.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path file);
  /// With a temporary name other than temporary_name().
  PartialFile(std::filesystem::path file, std::filesystem::path temporary);
  /// Removes the temporary file. Take a FileLock on it first if other processes may be writing it.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// `file` + ".partial".
  [[nodiscard]] static std::filesystem::path temporary_name(std::filesystem::path file) { return file += ".partial"; }

  /// Where the file is now: the temporary name, the final one after publish().
  [[nodiscard]] const std::filesystem::path& path() const { return is_published_ ? file_ : temporary_; }
  [[nodiscard]] const std::filesystem::path& final_path() const { return file_; }

  /// Gives the file its final name, replacing what had it. Throws Error(kFailed).
  void publish();

 private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  bool is_published_ = false;
};

/// Removes the temporary files of all PartialFiles of the process, which is about to end without their
/// destructors; none is published from then on.
void remove_unfinished_files();

/// Writes a file by way of a PartialFile. Throws Error(kFailed) naming it and the reason.
void write_file(const std::filesystem::path& file, std::string_view bytes);
/// The same for bytes in several places, one after the other.
void write_file(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces);

/// Keeps other processes from writing a file; the system releases the lock even when the process is killed.
class FileLock {
 public:
  /// Creates the file if it is missing. Throws Error(kFailed) if it cannot be written or is locked already.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Returns whether `file` still is the locked one: not removed, not replaced.
  [[nodiscard]] bool is_of(const std::filesystem::path& file) const;

 private:
  int descriptor_;
};

/// Returns whether any process holds a FileLock on the file.
[[nodiscard]] bool is_being_written(const std::filesystem::path& file);

/// Throws Error(kFailed): another run is writing that file.
[[noreturn]] void refuse_second_run(const std::filesystem::path& file);

/// File names that differ in a number: before + number + after.
struct NumberedName {
  std::filesystem::path folder{};
  std::string before{};
  std::string after{};
  int digits = 0;  // padded with zeros to at least so many

  [[nodiscard]] std::filesystem::path file(int number) const;
};

/// Returns whether the text contains a placeholder for a number.
[[nodiscard]] bool has_number(std::string_view text);

/// "f_{:04}.png" for "f_%04d.png" and "f_####.png", as other programs number their files; any other text as it is.
[[nodiscard]] std::string with_braces(std::string_view text);

/// Parses "folder/frame_{:04}.png", "{:04d}.obj", "{}.ply". Throws Error(kUsage) with a reason that ends in `examples`.
[[nodiscard]] NumberedName parse_numbered_name(std::string_view text, std::string_view examples);

/// FNV-1a (64 bits) of bytes that follow those of `hash`.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes, std::uint64_t hash = 0xcbf29ce484222325U);

/// That of a file's bytes, in hexadecimal; that of no bytes if it cannot be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// The hash of this program's own executable: tells builds apart.
[[nodiscard]] std::string build_of_this_program();

}  // namespace sprung
