#pragma once
#include <filesystem>
#include <string>

namespace sprung {

/// All bytes of a file (FNV-1a, 64 bits) in hexadecimal digits; that of no bytes where it cannot be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// The hash of this program's own file, so that no two builds are taken for one.
[[nodiscard]] std::string build_of_this_program();

}  // namespace sprung
