#include "tests/support/golden.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "render/png.h"

namespace sprung {

namespace {

const std::filesystem::path kGoldens = SPRUNG_GOLDEN_DIR;
const std::filesystem::path kKept = SPRUNG_KEEP_DIR;
constexpr int kBlock = 8;     // pixels
constexpr int kAmplify = 16;  // of a difference in the picture of differences
constexpr int kMiddle = 128;  // grey where there is none

double block_difference(const Image& a, const Image& b, int left, int top) {
  const int right = std::min(left + kBlock, a.width);
  const int bottom = std::min(top + kBlock, a.height);
  long sum = 0;
  for (int y = top; y < bottom; ++y) {
    for (int i = 3 * (y * a.width + left); i < 3 * (y * a.width + right); ++i) {
      const auto at = static_cast<std::size_t>(i);
      sum += std::abs(int{a.pixels[at]} - int{b.pixels[at]});
    }
  }
  return static_cast<double>(sum) / (3.0 * (right - left) * (bottom - top));
}

Image difference_picture(const Image& a, const Image& b) {
  Image picture(a.width, a.height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const int level = kMiddle + kAmplify * (int{a.pixels[i]} - int{b.pixels[i]});
    picture.pixels[i] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
  }
  return picture;
}

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

/// Keeps the picture; the words that say where, and how to accept it.
std::string keep(const Image& image, const std::string& name) {
  std::filesystem::create_directories(kKept);
  const std::filesystem::path file = kKept / (name + ".png");
  write_png(image, file);
  return fmt::format("the picture is kept as {}; if it is right: tests/accept-goldens {} {}", file.string(),
                     kKept.string(), name);
}

}  // namespace

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
  difference.mean = sum / (static_cast<double>(a.width) * a.height);
  return difference;
}

void expect_golden(const Image& image, const std::string& name, const GoldenTolerance& tolerance) {
  EXPECT_TRUE(image.width <= 320 && image.height <= 240) << "goldens are at most 320 x 240";
  const std::filesystem::path file = kGoldens / (name + ".png");
  if (!std::filesystem::exists(file)) {
    ADD_FAILURE() << "there is no golden " << file << "; " << keep(image, name);
    return;
  }
  const Image golden = read_png(file);
  if (!same_size(image, golden)) {
    ADD_FAILURE() << fmt::format("{} is {}x{}, the picture {}x{}; ", name, golden.width, golden.height, image.width,
                                 image.height)
                  << keep(image, name);
    return;
  }
  const ImageDifference difference = compare_images(image, golden);
  if (difference.mean <= tolerance.mean && difference.worst_block <= tolerance.worst_block) return;
  const std::string kept = keep(image, name);
  write_png(difference_picture(image, golden), kKept / (name + ".difference.png"));
  ADD_FAILURE()
      << fmt::format(
             "{} differs from its golden: mean {:.3f} (tolerance {}), worst block {:.2f} (tolerance {}) levels; ", name,
             difference.mean, tolerance.mean, difference.worst_block, tolerance.worst_block)
      << kept;
}

}  // namespace sprung
