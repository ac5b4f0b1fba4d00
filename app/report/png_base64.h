#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "render/image/image.h"

namespace sprung {

/// Base64 (RFC 4648, padded) of any bytes.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// A picture as the text of a PNG for a data: address. Goes through a file in the system's folder for temporary files.
/// Throws Error(kFailed).
[[nodiscard]] std::string png_base64(const Image& image);

}  // namespace sprung
