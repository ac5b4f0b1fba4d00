#include "render/image/legend.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/golden.h"

namespace sprung {
namespace {

Image grey(int width, int height) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{210});
  return image;
}

TEST(RoundTicks, AreRoundFewAndInside) {
  EXPECT_EQ(round_ticks(0, 1), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
  EXPECT_EQ(round_ticks(-30, 30), (std::vector<double>{-30, -20, -10, 0, 10, 20, 30}));
  for (const double high : {3e-9, 0.7, 1.0, 17.0, 999.0, 4.2e12}) {
    const std::vector<double> ticks = round_ticks(0.1 * high, high);
    EXPECT_GE(ticks.size(), 3U) << high;
    EXPECT_LE(ticks.size(), 8U) << high;
    EXPECT_GE(ticks.front(), 0.1 * high * (1 - 1e-6));
    EXPECT_LE(ticks.back(), high * (1 + 1e-6));
  }
}

TEST(RoundLength, IsOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_length(1), 1);
  EXPECT_DOUBLE_EQ(round_length(0.0499), 0.02);
  EXPECT_DOUBLE_EQ(round_length(731), 500);
}

TEST(ColorMaps, RiseInBrightnessWhereTheyShould) {
  for (const ColorMap map : {ColorMap::kViridis, ColorMap::kCividis}) {
    double before = -1;
    for (int i = 0; i <= 20; ++i) {
      const Eigen::Vector3f color = map_color(map, i / 20.0);
      const double brightness = Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F).dot(color);
      EXPECT_GT(brightness, before) << i;
      before = brightness;
    }
  }
  EXPECT_GT(map_color(ColorMap::kCoolwarm, 0).z(), map_color(ColorMap::kCoolwarm, 0).x());
  EXPECT_GT(map_color(ColorMap::kCoolwarm, 1).x(), map_color(ColorMap::kCoolwarm, 1).z());
  for (int i = 0; i < 10; ++i) {  // ember falls to its middle and rises again, as bright on both sides
    const auto brightness = [](double share) {
      return Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F).dot(map_color(ColorMap::kEmber, share));
    };
    EXPECT_GT(brightness(0.05 * i), brightness(0.05 * (i + 1))) << i;
    EXPECT_GT(brightness(1 - 0.05 * i), brightness(1 - 0.05 * (i + 1))) << i;
  }
  EXPECT_GT(map_color(ColorMap::kEmber, 0).z(), map_color(ColorMap::kEmber, 1).z());
  EXPECT_EQ(map_color(ColorMap::kTurbo, 7), map_color(ColorMap::kTurbo, 1));
}

TEST(Font, KnowsHowWideAText) {
  const Font font;
  EXPECT_EQ(font.width("", 20), 0);
  EXPECT_NEAR(font.width("11", 20), 2 * font.width("1", 20), 1e-9);
  EXPECT_NEAR(font.width("kPa", 40), 2 * font.width("kPa", 20), 1e-6);
  EXPECT_GT(font.width("\xc2\xb5m", 20), font.width("m", 20));  // two bytes, one letter
}

TEST(RenderGolden, LegendAndLabels) {
  const Font font;
  Image image = grey(320, 180);
  draw_legend(image, {.title = "Stress, kPa", .map = ColorMap::kTurbo, .low = 0, .high = 3.4, .swatches = {}}, font);
  draw_caption(image, "A bar, pulled", font);
  draw_footer(image, "7 / 24   0.25 s", font);
  draw_scale_bar(image, 60, "5 cm", font);
  expect_golden(image, "render_legend");
}

TEST(Font, WritesIntoTheAlphaToo) {
  const Font font;
  Image image(40, 20);
  image.alpha.assign(800, 0);
  font.write(image, 5, 15, 16, "H", {0, 0, 0});
  EXPECT_GT(*std::max_element(image.alpha.begin(), image.alpha.end()), 240);
  EXPECT_EQ(image.alpha[0], 0);
}

}  // namespace
}  // namespace sprung
