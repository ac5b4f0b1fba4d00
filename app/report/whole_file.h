#pragma once
#include <filesystem>
#include <string_view>

namespace sprung {

/// Writes a text beside its name and renames it, so that no half file stays. Throws Error(kFailed) naming the file and
/// the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view text);

}  // namespace sprung
