#include "render/trace/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace sprung {
namespace {

/// Whether each of `count` equal parts of the square, `columns` beside each other, holds one of the second pairs.
bool fill_evenly(int count, int columns, const std::function<Sampler(int)>& sampler_of) {
  std::set<int> cells;
  for (int i = 0; i < count; ++i) {
    Sampler sampler = sampler_of(i);
    static_cast<void>(sampler.pair());  // the second pair is as good as the first
    const Eigen::Vector2f at = sampler.pair();
    const int rows = count / columns;
    cells.insert(int(at.x() * float(columns)) * rows + int(at.y() * float(rows)));
  }
  return cells.size() == std::size_t(count);
}

TEST(Sampler, PairsOfAPixelFillTheSquareEvenly) {
  for (const int x : {0, 1, 777, 32767}) {
    for (const int columns : {1, 2, 4, 8, 16}) {
      EXPECT_TRUE(fill_evenly(16, columns, [x](int i) { return Sampler(x, 55, i, 16); })) << x << ' ' << columns;
    }
  }
}

TEST(Sampler, PairsOfABlockOfPixelsFillTheSquareEvenly) {
  for (const int columns : {1, 4, 16, 64, 256}) {
    EXPECT_TRUE(fill_evenly(256, columns, [](int i) { return Sampler(404 + i / 16 % 4, 96 + i / 64, i % 16, 16); }))
        << columns;
  }
}

TEST(Sampler, NumbersAreBelowOneAndCentred) {
  double sum = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    Sampler sampler(3 * 4096 + i);
    const Eigen::Vector2f at = sampler.pair();
    ASSERT_GE(at.minCoeff(), 0);
    ASSERT_LT(at.maxCoeff(), 1);
    sum += double{at.x()} + double{at.y()};
  }
  EXPECT_NEAR(sum / 8192, 0.5, 1e-3);
}

TEST(Sampler, PairsAreIndependent) {
  double product = 0;
  for (std::uint64_t block = 0; block < 4000; ++block) {
    Sampler sampler(4096 * block);
    const float first = sampler.number();
    const float second = sampler.number();
    product += (double{first} - 0.5) * (double{second} - 0.5);
  }
  EXPECT_NEAR(product / 4000, 0, 0.005);  // 1/12 if they were equal; 0.0013 is one standard deviation
}

}  // namespace
}  // namespace sprung
