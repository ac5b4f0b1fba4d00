#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/image/image.h"

namespace sprung {

/// The bytes of a PNG file (ISO/IEC 15948).
[[nodiscard]] std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes a PNG under a temporary name and renames it, so that no partial picture remains. Throws Error(kFailed) naming
/// the file and the system's reason.
void write_png(const Image& image, const std::filesystem::path& file);

/// Reads a PNG as 8-bit RGB, with alpha if it is not opaque. Throws Error(kBadInput).
[[nodiscard]] Image read_png(const std::filesystem::path& file);

}  // namespace sprung
