#pragma once
#include <cmath>
#include <cstdint>

namespace sprung {

/// sRGB, 8 bits per channel.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// The transfer function of IEC 61966-2-1 for one channel in [0, 1], and its inverse.
[[nodiscard]] inline float linear_from_srgb(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}
[[nodiscard]] inline float srgb_from_linear(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

/// How a surface is shaded.
enum class Look {
  kPlastic,  // smooth, soft highlights; for toys
  kGelatin,  // translucent, wet highlights
  kRubber,   // matt
  kSteel,    // polished metal
  kChart     // matt and self-lit, for colours that encode values
};

}  // namespace sprung
