#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sprung {

/// RGBA, 8-bit sRGB, rows from the top.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height
};

/// An equirectangular environment map: rows from the zenith to the nadir, -z in the middle of a row and +x a quarter of
/// a row to its right.
struct Panorama {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> light;  // linear RGB; width * height
};

/// Decodes PNG, JPEG, TGA, BMP, GIF or PSD. Throws Error(kBadInput) with `name` and the reason.
[[nodiscard]] Pixels decode_pixels(std::span<const std::byte> encoded, const std::string& name);

/// The same formats and Radiance .hdr; 8-bit images are decoded with gamma 2.2. Throws as decode_pixels() does.
[[nodiscard]] Panorama decode_panorama(std::span<const std::byte> encoded, const std::string& name);

}  // namespace sprung
