#include "render/trace/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace sprung {
namespace {

/// Of the first 16 samples each strip of that width and height holds exactly one, whatever its shape.
TEST(Sampler, PairsFillTheSquareEvenly) {
  for (std::uint32_t pixel : {0U, 1U, 777U, 921599U}) {
    for (const int columns : {1, 2, 4, 8, 16}) {
      std::set<int> cells;
      for (std::uint32_t i = 0; i < 16; ++i) {
        Sampler sampler(pixel, i);
        static_cast<void>(sampler.pair());  // the second pair is as good as the first
        const Eigen::Vector2f at = sampler.pair();
        const int rows = 16 / columns;
        cells.insert(int(at.x() * float(columns)) * rows + int(at.y() * float(rows)));
      }
      EXPECT_EQ(cells.size(), 16U) << pixel << ' ' << columns;
    }
  }
}

TEST(Sampler, NumbersAreBelowOneAndCentred) {
  double sum = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    Sampler sampler(3, i);
    const Eigen::Vector2f at = sampler.pair();
    ASSERT_GE(at.minCoeff(), 0);
    ASSERT_LT(at.maxCoeff(), 1);
    sum += double{at.x()} + double{at.y()};
  }
  EXPECT_NEAR(sum / 8192, 0.5, 1e-3);
}

TEST(Sampler, PairsAndPixelsAreIndependent) {
  double product = 0;
  for (std::uint32_t pixel = 0; pixel < 4000; ++pixel) {
    Sampler sampler(pixel, 0);
    const float first = sampler.number();
    const float second = sampler.number();
    product += (double{first} - 0.5) * (double{second} - 0.5);
  }
  EXPECT_NEAR(product / 4000, 0, 0.005);  // 1/12 if they were equal; 0.0013 is one standard deviation
}

}  // namespace
}  // namespace sprung
