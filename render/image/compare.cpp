#include "render/image/compare.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace sprung {

namespace {

constexpr int kBlock = 8;     // pixels
constexpr int kAmplify = 16;  // of differences in difference_picture()
constexpr int kMiddle = 128;  // grey where there is no difference

double block_difference(const Image& a, const Image& b, int left, int top) {
  const int right = std::min(left + kBlock, a.width);
  const int bottom = std::min(top + kBlock, a.height);
  long sum = 0;
  for (int y = top; y < bottom; ++y) {
    for (int i = 3 * (y * a.width + left); i < 3 * (y * a.width + right); ++i) {
      const std::size_t at = i;
      sum += std::abs(int{a.pixels[at]} - int{b.pixels[at]});
    }
  }
  return double(sum) / (3.0 * (right - left) * (bottom - top));
}

/// Rec. 709 weights of the stored bytes.
double brightness(const Image& image, std::size_t pixel) {
  const std::uint8_t* rgb = image.pixels.data() + 3 * pixel;
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Sums over rectangles of pixels by a summed-area table.
class Sums {
 public:
  template <class Value>
  Sums(int width, int height, Value value)
      : stride_(std::size_t(width) + 1), sums_(stride_ * (std::size_t(height) + 1)) {
    for (std::size_t y = 0; y < std::size_t(height); ++y) {
      double row = 0;
      for (std::size_t x = 0; x + 1 < stride_; ++x) {
        row += value(y * (stride_ - 1) + x);
        sums_[(y + 1) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + row;
      }
    }
  }
  [[nodiscard]] double of(int left, int top, int width, int height) const {
    return at(left + width, top + height) - at(left, top + height) - at(left + width, top) + at(left, top);
  }

 private:
  [[nodiscard]] double at(int x, int y) const { return sums_[std::size_t(y) * stride_ + x]; }
  std::size_t stride_;
  std::vector<double> sums_;
};

}  // namespace

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

ImageDifference compare_images(const Image& a, const Image& b) {
  ImageDifference difference;
  double sum = 0;
  for (int top = 0; top < a.height; top += kBlock) {
    for (int left = 0; left < a.width; left += kBlock) {
      const double block = block_difference(a, b, left, top);
      difference.worst_block = std::max(difference.worst_block, block);
      sum += block * std::min(kBlock, a.width - left) * std::min(kBlock, a.height - top);
    }
  }
  difference.mean = sum / (double(a.width) * a.height);
  return difference;
}

double structural_similarity(const Image& a, const Image& b) {
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255;
  constexpr double kC2 = 0.03 * 255 * 0.03 * 255;
  const auto sums = [&](auto value) { return Sums(a.width, a.height, value); };
  const Sums sum_a = sums([&](std::size_t p) { return brightness(a, p); });
  const Sums sum_b = sums([&](std::size_t p) { return brightness(b, p); });
  const Sums sum_aa = sums([&](std::size_t p) { return brightness(a, p) * brightness(a, p); });
  const Sums sum_bb = sums([&](std::size_t p) { return brightness(b, p) * brightness(b, p); });
  const Sums sum_ab = sums([&](std::size_t p) { return brightness(a, p) * brightness(b, p); });
  const int width = std::min(kBlock, a.width);
  const int height = std::min(kBlock, a.height);
  const double pixels = double(width) * height;
  double total = 0;
  long windows = 0;
  for (int y = 0; y + height <= a.height; ++y) {
    for (int x = 0; x + width <= a.width; ++x, ++windows) {
      const auto mean = [&](const Sums& of) { return of.of(x, y, width, height) / pixels; };
      const double ma = mean(sum_a);
      const double mb = mean(sum_b);
      const double va = mean(sum_aa) - ma * ma;
      const double vb = mean(sum_bb) - mb * mb;
      const double ab = mean(sum_ab) - ma * mb;
      total += (2 * ma * mb + kC1) * (2 * ab + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2));
    }
  }
  return total / double(windows);
}

Image difference_picture(const Image& a, const Image& b) {
  Image picture(a.width, a.height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const int level = kMiddle + kAmplify * (int{a.pixels[i]} - int{b.pixels[i]});
    picture.pixels[i] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
  }
  return picture;
}

}  // namespace sprung
