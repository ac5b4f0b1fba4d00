#include "core/mesh/query/closest_triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace sprung {
namespace {

TEST(NearestTriangle, FindsFacesEdgesAndCorners) {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5;
  Triangles triangles(3, 3);
  triangles << 0, 1, 1, 0, 1, 2, 0, 2, 3;  // the first has no area
  const NearestTriangle surface(points, triangles);
  const SurfaceProjection face = surface.at(Vec3(0.25, 0.25, -2));
  EXPECT_EQ(face.triangle, 1);
  EXPECT_LT((face.point - Vec3(0.25, 0.25, 0)).norm(), 1e-12);
  EXPECT_NEAR(face.distance, 2, 1e-12);
  EXPECT_LT((surface.at(Vec3(0.5, -3, 0)).point - Vec3(0.5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((surface.at(Vec3(9, -1, 0)).point - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(surface.at(Vec3(-1, 0.1, 4)).triangle, 2);
}

/// No corner or middle of any triangle is nearer than what it finds.
TEST(NearestTriangle, NothingIsNearer) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  Points points(90, 3);
  for (double& coordinate : points.reshaped()) coordinate = number(random);
  Triangles triangles(30, 3);
  for (int i = 0; i < 90; ++i) triangles(i / 3, i % 3) = i;
  const NearestTriangle surface(points, triangles);
  for (int round = 0; round < 200; ++round) {
    const Vec3 place(number(random), number(random), number(random));
    const SurfaceProjection found = surface.at(place);
    EXPECT_NEAR((found.point - place).norm(), found.distance, 1e-12);
    for (int t = 0; t < 30; ++t) {
      const Vec3 middle = (points.row(3 * t) + points.row(3 * t + 1) + points.row(3 * t + 2)).transpose() / 3;
      EXPECT_GE((middle - place).norm(), found.distance - 1e-12);
      for (int i = 0; i < 3; ++i) EXPECT_GE((points.row(3 * t + i).transpose() - place).norm(), found.distance - 1e-12);
    }
  }
}

}  // namespace
}  // namespace sprung
