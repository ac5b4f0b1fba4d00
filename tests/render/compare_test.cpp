#include "render/image/compare.h"

#include <gtest/gtest.h>

#include <random>

namespace sprung {
namespace {

Image noise(unsigned seed, int amount) {
  std::mt19937 random(seed);
  Image image(48, 32);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const int wave = 100 + int(i % 144);
    image.pixels[i] = static_cast<std::uint8_t>(wave + int(random() % unsigned(amount + 1)));
  }
  return image;
}

TEST(StructuralSimilarity, IsOneForTheSameAndFallsWithNoise) {
  const Image clean = noise(1, 0);
  EXPECT_NEAR(structural_similarity(clean, clean), 1, 1e-12);
  const double little = structural_similarity(clean, noise(1, 4));
  const double more = structural_similarity(clean, noise(1, 12));
  EXPECT_LT(little, 1);
  EXPECT_LT(more, little);
  EXPECT_NEAR(structural_similarity(noise(1, 12), clean), more, 1e-12);
}

// Constant pictures: (2 a b + C1) / (a^2 + b^2 + C1).
TEST(StructuralSimilarity, FollowsTheFormulaForPlainPictures) {
  Image a(20, 9);
  Image b(20, 9);
  std::fill(a.pixels.begin(), a.pixels.end(), std::uint8_t{100});
  std::fill(b.pixels.begin(), b.pixels.end(), std::uint8_t{120});
  const double c1 = 0.01 * 255 * 0.01 * 255;
  EXPECT_NEAR(structural_similarity(a, b), (2 * 100 * 120 + c1) / (100 * 100 + 120 * 120 + c1), 1e-9);
  EXPECT_LT(structural_similarity(Image(3, 2), Image(3, 2)), 1 + 1e-12);
}

}  // namespace
}  // namespace sprung
