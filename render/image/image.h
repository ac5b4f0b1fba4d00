#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// An 8-bit sRGB picture, rows from the top, RGB interleaved without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // 3 * width * height
  std::vector<std::uint8_t> alpha;   // width * height, not premultiplied; empty: opaque

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(3U * std::size_t(w) * std::size_t(h)) {}
};

/// RGB, or RGBA if the picture has alpha, pixel by pixel.
[[nodiscard]] std::vector<std::uint8_t> interleaved(const Image& image);

/// kPreview takes one sample per pixel and coarse shadows, kDefault four, kHigh sixteen and fine shadows; kFinal traces
/// the paths of light.
enum class Quality { kPreview, kDefault, kHigh, kFinal };

/// Samples per pixel.
[[nodiscard]] constexpr int samples_of(Quality quality) {
  return quality == Quality::kPreview ? 1 : quality == Quality::kDefault ? 4 : 16;
}

/// Time spent in one stage of drawing, over all pictures so far.
struct DrawTime {
  std::string_view pass;
  double wall = 0;       // s
  double processor = 0;  // s, of all threads
};

/// The passes that a compositor needs in addition to a picture, rows from the top. Beauty, shadow and occlusion are
/// antialiased; the others are sampled at pixel centres and leave ghosts out.
struct Passes {
  using Plane = std::vector<float>;  // width * height

  int width = 0;
  int height = 0;
  std::array<Plane, 4> beauty;    // red, green, blue: linear light before the tone curve, times opacity; opacity
  Plane shadow;                   // fraction of the key light that reaches what is seen; 1 for the background
  Plane occlusion;                // fraction of the sky that is open above it; 1 for the background
  Plane depth;                    // m, along the camera's axis; kNothing for the background
  std::array<Plane, 3> normal;    // x, y, z: unit, world space, towards the camera; 0 for the background
  std::array<Plane, 3> position;  // x, y, z: m, world space; 0 for the background
  Plane id;                       // Stage::ids; 0 for the ground and the background
  std::array<Plane, 3> uv;        // u, v of the skin's texture, 0 if there is none; and 1 on skins
  /// Pixels, to the right and up, by which the visible point moved: from here to where it was one frame before (the
  /// first two), and from where it will be one frame later to here, as in Cycles. 0 for the background.
  std::array<Plane, 4> motion;

  /// Stage::ids of what covers most of the pixel, of what covers the next largest part, and so on, 0 being the ground;
  /// and these parts, of 1. Unused entries are -1 and 0.
  static constexpr std::size_t kRanks = 6;
  std::array<Plane, kRanks> matte;
  std::array<Plane, kRanks> coverage;
  std::vector<std::string> names;  // by id, each once

  static constexpr float kNothing = 1e10F;

  Passes() = default;
  Passes(int w, int h) : width(w), height(h) {
    const auto size = std::size_t(w) * std::size_t(h);
    beauty.fill(Plane(size, 0));
    shadow.assign(size, 1);
    occlusion.assign(size, 1);
    depth.assign(size, kNothing);
    normal.fill(Plane(size, 0));
    position.fill(Plane(size, 0));
    id.assign(size, 0);
    uv.fill(Plane(size, 0));
    motion.fill(Plane(size, 0));
    matte.fill(Plane(size, -1));
    coverage.fill(Plane(size, 0));
  }
};

}  // namespace sprung
