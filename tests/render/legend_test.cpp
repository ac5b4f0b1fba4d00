#include "render/image/legend.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/types.h"
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
  for (int i = 0; i < 10; ++i) {  // ember rises to its middle and falls again, as bright on both sides
    const auto brightness = [](double share) {
      return Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F).dot(map_color(ColorMap::kEmber, share));
    };
    EXPECT_LT(brightness(0.05 * i), brightness(0.05 * (i + 1))) << i;
    EXPECT_LT(brightness(1 - 0.05 * i), brightness(1 - 0.05 * (i + 1))) << i;
    EXPECT_NEAR(brightness(0.05 * i), brightness(1 - 0.05 * i), 0.05) << i;
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

TEST(Labels, FitIntoTheirRoom) {
  const Font font;
  const std::string name = "runs/007 \u00c5ngstr\u00f6m, soft, second attempt.h5";
  const double width = font.width(name, 20);
  EXPECT_EQ(fitted(name, 20, width + 1, font).text, name);
  EXPECT_EQ(fitted(name, 20, width + 1, font).size, 20);
  EXPECT_EQ(fitted(name, 20, 0.8 * width, font).text, name) << "in smaller letters";
  for (const double share : {0.8, 0.6, 0.3, 0.1, 0.0}) {
    const FittedText line = fitted(name, 20, share * width, font);
    EXPECT_LE(font.width(line.text, line.size), share * width + 0.01);
    EXPECT_GE(line.size, 13);
  }
  const std::string half = fitted(name, 20, 0.4 * width, font).text;
  EXPECT_EQ(half.substr(0, 4), "runs");
  EXPECT_EQ(half.substr(half.size() - 3), ".h5");
  EXPECT_NE(half.find("\u2026"), std::string::npos);
}

/// Columns and rows with letters in them.
AlignedBox letters_in(const Image& before, const Image& after) {
  AlignedBox box;
  for (int y = 0; y < after.height; ++y) {
    for (int x = 0; x < after.width; ++x) {
      const std::size_t at = 3 * (std::size_t(y) * std::size_t(after.width) + std::size_t(x));
      if (std::abs(after.pixels[at] - before.pixels[at]) > 60) box.extend(Vec3(x, y, 0));
    }
  }
  return box;
}

TEST(Labels, DoNotRunIntoEachOther) {
  const Font font;
  const Image empty = grey(160, 120);
  Image image = empty;
  draw_caption(image, "A caption that is longer than the picture is wide", font);
  const AlignedBox caption = letters_in(empty, image);
  Image named = image;
  draw_name(named, "a run with a long name, runs/0001/run.h5", font, true);
  const AlignedBox name = letters_in(image, named);
  EXPECT_GT(name.min().y(), caption.max().y());
  for (const AlignedBox& box : {caption, name}) {
    EXPECT_GT(box.min().x(), 2);
    EXPECT_LT(box.max().x(), 157);
  }
  Image footed = empty;
  draw_scale_bar(footed, 50, "5 cm", font);
  const AlignedBox bar = letters_in(empty, footed);
  Image both = footed;
  draw_footer(both, "1234 / 5678   123.45 s", font, scale_bar_width(50, "5 cm", 120, font) + 11);
  EXPECT_LT(letters_in(footed, both).max().x(), bar.min().x());
}

TEST(Font, WritesIntoTheAlphaToo) {
  const Font font;
  Image image(40, 20);
  image.alpha.assign(800, 0);
  font.write(image, 5, 15, 16, "H", {0, 0, 0});
  EXPECT_GT(*std::max_element(image.alpha.begin(), image.alpha.end()), 230);
  EXPECT_EQ(image.alpha[0], 0);
}

}  // namespace
}  // namespace sprung
