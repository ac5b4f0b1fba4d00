#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace sprung {

/// An 8-bit sRGB picture, rows from the top, RGB interleaved without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // 3 * width * height
  std::vector<std::uint8_t> alpha;   // width * height, the colours not multiplied by it; empty: opaque

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(3U * std::size_t(w) * std::size_t(h)) {}
};

/// How fine light and edges are drawn: kPreview takes one sample a pixel and coarse shadows, kDefault four, kHigh
/// sixteen and fine shadows.
enum class Quality { kPreview, kDefault, kHigh };

/// Samples of a pixel.
[[nodiscard]] constexpr int samples_of(Quality quality) {
  return quality == Quality::kPreview ? 1 : quality == Quality::kDefault ? 4 : 16;
}

/// What one pass of drawing has taken, of all pictures so far.
struct PassTime {
  std::string_view pass;
  double wall = 0;       // s
  double processor = 0;  // s, of all threads
};

/// What a compositor needs beside a picture: what is seen through the middle of every pixel, rows from the top. Nothing
/// is mixed at edges, and ghosts are left out.
struct Passes {
  using Plane = std::vector<float>;  // width * height

  int width = 0;
  int height = 0;
  Plane depth;                    // m, along the camera's axis; kNothing where there is nothing
  std::array<Plane, 3> normal;    // x, y, z: unit, in the world, towards the camera; 0 where there is nothing
  std::array<Plane, 3> position;  // x, y, z: m, in the world; 0 where there is nothing
  Plane id;                       // as the stage has them; 0 for the ground and where there is nothing

  static constexpr float kNothing = 1e10F;

  Passes() = default;
  Passes(int w, int h) : width(w), height(h) {
    const auto size = std::size_t(w) * std::size_t(h);
    depth.assign(size, kNothing);
    normal.fill(Plane(size, 0));
    position.fill(Plane(size, 0));
    id.assign(size, 0);
  }
};

}  // namespace sprung
