#pragma once
#include "render/image/image.h"

namespace sprung {

/// How two pictures of the same size differ.
struct ImageDifference {
  double mean = 0;         // mean absolute difference of all bytes, in levels of 255
  double worst_block = 0;  // the largest mean of an 8 x 8 block
};

[[nodiscard]] bool same_size(const Image& a, const Image& b);

/// Both of the same size.
[[nodiscard]] ImageDifference compare_images(const Image& a, const Image& b);

/// Structural similarity of luma, 1 for equal pictures: the mean over all 8 x 8 windows, with uniform weights (Wang,
/// Bovik, Sheikh and Simoncelli, "Image Quality Assessment", 2004). A picture with a side under 8 pixels is one window.
[[nodiscard]] double structural_similarity(const Image& a, const Image& b);

/// 16 times the difference: grey where they are equal, lighter where `a` is lighter.
[[nodiscard]] Image difference_picture(const Image& a, const Image& b);

}  // namespace sprung
