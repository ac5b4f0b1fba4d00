#pragma once
#include <filesystem>

namespace sprung {

/// Finds out whether a file can be written there by writing one beside it; folders are made where they are missing.
/// Everything that it made is gone afterwards. Throws Error(kFailed) naming the folder or the file and the reason.
void check_writable(const std::filesystem::path& file);

/// Makes a folder and those above it. Throws Error(kFailed) naming it and the reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace sprung
