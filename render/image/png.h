#pragma once
#include <filesystem>

#include "render/image/image.h"

namespace sprung {

/// Writes a PNG beside its name and renames it, so that no partial file stays. Throws Error(kFailed) naming the file
/// and the system's reason.
void write_png(const Image& image, const std::filesystem::path& file);

/// Reads a PNG as 8-bit RGB, with alpha where it is not opaque. Throws Error(kBadInput).
[[nodiscard]] Image read_png(const std::filesystem::path& file);

}  // namespace sprung
