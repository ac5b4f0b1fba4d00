#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace sprung {

/// Finds out whether a file can be written there by writing one beside it; folders are made where they are missing.
/// Everything that it made is gone afterwards. Throws Error(kFailed) naming the folder or the file and the reason.
void check_writable(const std::filesystem::path& file);

/// Makes a folder and those above it. Throws Error(kFailed) naming it and the reason.
void make_folder(const std::filesystem::path& folder);

/// Names of files that differ in a number.
struct NumberedName {
  std::filesystem::path folder{};
  std::string before{};  // a name is before + number + after
  std::string after{};
  int digits = 0;  // leading zeros up to that many digits; more where the number has more

  [[nodiscard]] std::filesystem::path file(int number) const;
};

/// True where the words have a place for a number.
[[nodiscard]] bool has_number(std::string_view words);

/// "folder/frame_{:04}.png", "{:04d}.obj", "{}.ply". Throws Error(kUsage) with a reason that ends in `examples`.
[[nodiscard]] NumberedName parse_numbered_name(std::string_view words, std::string_view examples);

/// Writes a text beside its name and renames it, so that no half file stays. Throws Error(kFailed) naming the file and
/// the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view text);

/// All bytes of a file (FNV-1a, 64 bits) in hexadecimal digits; that of no bytes where it cannot be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// The hash of this program's own file, so that no two builds are taken for one.
[[nodiscard]] std::string build_of_this_program();

}  // namespace sprung
