#include "app/report/axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace sprung {
namespace {

TEST(Axis, CoversItsData) {
  constexpr std::array<std::array<double, 2>, 8> kSpans{
      {{0, 1}, {-3.2, 17}, {0.0012, 0.0013}, {5, 5}, {0, 0}, {-1e6, 3e6}, {0.9, 1.1}, {1e-9, 2e-7}}};
  for (const auto& [low, high] : kSpans) {
    const AxisRange range = axis_range({.label = "m"}, low, high);
    ASSERT_GE(range.ticks.size(), 3U) << low << " to " << high;
    EXPECT_LE(range.ticks.size(), 11U) << low << " to " << high;
    EXPECT_LE(range.ticks.front(), low + 1e-9 * std::abs(low));
    EXPECT_GE(range.ticks.back(), high - 1e-9 * std::abs(high));
    EXPECT_TRUE(std::is_sorted(range.ticks.begin(), range.ticks.end()));
  }
}

TEST(Axis, CoversItsDataOnALogScale) {
  constexpr std::array<std::array<double, 2>, 6> kSpans{
      {{1, 8}, {0.063, 57}, {3, 3}, {1e-14, 0.2}, {0.5, 2}, {10, 1000}}};
  for (const auto& [low, high] : kSpans) {
    const AxisRange range = axis_range({.label = "m", .scale = Scale::kLog}, low, high);
    EXPECT_LE(range.low, low * (1 + 1e-9));
    EXPECT_GE(range.high, high * (1 - 1e-9));
    EXPECT_GE(range.ticks.size(), 2U) << low << " to " << high;
    for (const double tick : range.ticks) {
      EXPECT_GE(range.fraction(tick), -1e-9);
      EXPECT_LE(range.fraction(tick), 1 + 1e-9);
    }
  }
  const AxisRange decades = axis_range({.label = "m", .scale = Scale::kLog}, 1, 1000);
  EXPECT_NEAR(decades.fraction(10), 1.0 / 3, 1e-12);
}

TEST(Axis, WritesTicksAsPeopleDo) {
  EXPECT_EQ(tick_texts(axis_range({.label = "m"}, -1, 1)),
            (std::vector<std::string>{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 0.1, 100)),
            (std::vector<std::string>{"0.1", "1", "10", "100"}));
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .scale = Scale::kLog}, 1e-6, 2e-5)).front(), "10⁻⁶");
  EXPECT_EQ(tick_texts(axis_range({.label = "m", .ticks = {0, 0.25, 0.5}}, 0, 0.5)),
            (std::vector<std::string>{"0.00", "0.25", "0.50"}));
}

}  // namespace
}  // namespace sprung
