#include "core/contact/pairs/closest_features.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace sprung {
namespace {

/// Random corners, also in a plane and on a line, where features are parallel or have no area.
std::array<Vec3, 4> random_corners(std::mt19937& random) {
  std::uniform_real_distribution<double> in_cube(-1, 1);
  std::uniform_int_distribution<int> kind(0, 3);
  const int flat = kind(random);
  std::array<Vec3, 4> x;
  for (Vec3& corner : x) corner = {in_cube(random), in_cube(random), flat == 1 ? 0 : in_cube(random)};
  if (flat == 2) x[3] = x[2] + (x[1] - x[0]);  // parallel edges
  if (flat == 3) x[3] = 0.3 * x[1] + 0.7 * x[2];
  return x;
}

/// The least distance over a lattice of points of both features; `step`: of their weights.
double sampled_distance(const std::array<Vec3, 4>& x, bool is_point, double step) {
  double least = 1e300;
  for (double u = 0; u <= 1 + 1e-9; u += step) {
    for (double v = 0; v <= (is_point ? 1 - u : 1) + 1e-9; v += step) {
      const Vec3 apart = is_point ? Vec3(x[0] - ((1 - u - v) * x[1] + u * x[2] + v * x[3]))
                                  : Vec3((1 - u) * x[0] + u * x[1] - (1 - v) * x[2] - v * x[3]);
      least = std::min(least, apart.norm());
    }
  }
  return least;
}

class ClosestFeatures : public testing::TestWithParam<bool> {};

TEST_P(ClosestFeatures, AreNoFurtherThanAnySampledPlaces) {
  std::mt19937 random(7);
  constexpr double kStep = 0.02;
  for (int i = 0; i < 500; ++i) {
    const std::array<Vec3, 4> x = random_corners(random);
    const FeatureDistance found =
        GetParam() ? point_to_triangle(x[0], x[1], x[2], x[3]) : edge_to_edge(x[0], x[1], x[2], x[3]);
    const double sampled = sampled_distance(x, GetParam(), kStep);
    EXPECT_LE(found.apart.norm(), sampled + 1e-12) << i;
    EXPECT_GE(found.apart.norm(), sampled - 4 * kStep) << i;
    const int count = GetParam() ? 1 : 2;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 4; ++k) sum += found.weights[k] * x[k];
    EXPECT_LT((sum - found.apart).norm(), 1e-12) << i;
    EXPECT_NEAR(found.weights.head(count).sum(), 1, 1e-12) << i;
    EXPECT_NEAR(found.weights.tail(4 - count).sum(), -1, 1e-12) << i;
    EXPECT_GE(found.weights.head(count).minCoeff(), -1e-12) << i;
    EXPECT_LE(found.weights.tail(4 - count).maxCoeff(), 1e-12) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(PointsAndEdges, ClosestFeatures, testing::Bool());

TEST(ClosestFeatures, EdgesWithoutLengthArePoints) {
  const FeatureDistance found = edge_to_edge({0, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(found.apart.norm(), 1, 1e-15);
}

}  // namespace
}  // namespace sprung
