#pragma once
#include <cstdint>

namespace sprung {

/// sRGB, 8 bits a channel.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// How a surface takes light.
enum class Look {
  kPlastic,  // smooth, softly lit; for toys
  kGelatin,  // light goes through, wet highlights
  kRubber,   // matt
  kSteel,    // polished metal
  kChart     // matt, and bright by itself: its colours stand for something
};

}  // namespace sprung
