#pragma once

namespace sprung {

/// How fine light and edges are drawn: kPreview takes one sample a pixel and coarse shadows, kDefault four, kHigh
/// sixteen and fine shadows.
enum class Quality { kPreview, kDefault, kHigh };

/// Samples of a pixel.
[[nodiscard]] constexpr int samples_of(Quality quality) {
  return quality == Quality::kPreview ? 1 : quality == Quality::kDefault ? 4 : 16;
}

}  // namespace sprung
