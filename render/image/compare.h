#pragma once
#include "render/image/image.h"

namespace sprung {

/// How two pictures of the same size differ.
struct ImageDifference {
  double mean = 0;         // mean absolute difference of all bytes, in levels of 255
  double worst_block = 0;  // the same of the worst 8 x 8 block
};

[[nodiscard]] bool same_size(const Image& a, const Image& b);

/// Both of the same size.
[[nodiscard]] ImageDifference compare_images(const Image& a, const Image& b);

/// Structural similarity of their brightness, 1 where they are the same: the mean over all 8 x 8 windows, each a pixel
/// from the next, of Wang, Bovik, Sheikh and Simoncelli, "Image Quality Assessment" (2004), with even weights. Of
/// pictures with a side under 8 pixels one window is all of it.
[[nodiscard]] double structural_similarity(const Image& a, const Image& b);

/// Grey where they are the same, lighter where `a` is; 16 times what they differ by.
[[nodiscard]] Image difference_picture(const Image& a, const Image& b);

}  // namespace sprung
