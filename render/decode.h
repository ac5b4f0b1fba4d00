#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sprung {

/// A decoded picture: rows from the top, RGBA, 8 bits, sRGB.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height
};

/// Decodes PNG, JPEG, TGA, BMP, GIF or PSD. Throws Error(kBadInput) naming `name` and what is wrong with it.
[[nodiscard]] Pixels decode_pixels(std::span<const std::byte> encoded, const std::string& name);

}  // namespace sprung
