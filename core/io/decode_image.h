#pragma once
#include <Eigen/Core>
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

/// Light from all around: rows from straight up to straight down, each once around the vertical, with -z in its middle
/// and +x a quarter to its right.
struct Panorama {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> light;  // linear; width * height
};

/// Decodes PNG, JPEG, TGA, BMP, GIF or PSD. Throws Error(kBadInput) naming `name` and what is wrong with it.
[[nodiscard]] Pixels decode_pixels(std::span<const std::byte> encoded, const std::string& name);

/// The same, or Radiance .hdr; what has 8 bits is taken for the power 1 / 2.2 of light. Throws as decode_pixels() does.
[[nodiscard]] Panorama decode_panorama(std::span<const std::byte> encoded, const std::string& name);

}  // namespace sprung
