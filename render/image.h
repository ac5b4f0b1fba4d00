#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sprung {

/// An 8-bit sRGB picture, rows from the top, RGB interleaved without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // 3 * width * height
  std::vector<std::uint8_t> alpha;   // width * height, the colours not multiplied by it; empty: opaque

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(3U * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

}  // namespace sprung
