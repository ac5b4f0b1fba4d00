#include "render/stage/coarse_triangles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "render/stage/visible_sides.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

Skin ball() { return make_sphere_skin({0, 0, 0}, 1); }

double volume(const Skin& skin, const Triangles& triangles) {
  double sum = 0;
  for (const auto& row : triangles.rowwise()) {
    const auto corner = [&](int k) -> Vec3 { return skin.positions.row(row[k]); };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

TEST(CoarseTriangles, AreFewerAndHoldTheSameSolid) {
  const Skin skin = ball();
  const CoarseTriangles coarse = coarse_triangles(skin, 0.2);
  EXPECT_LT(coarse.triangles.rows(), skin.triangles.rows() / 2);
  EXPECT_NEAR(volume(skin, coarse.triangles), volume(skin, skin.triangles), 0.06 * volume(skin, skin.triangles));
}

// The seam of the UVs runs from pole to pole with vertices of its own on each side.
TEST(CoarseTriangles, HaveNoCracks) {
  Skin skin = ball();
  skin.triangles = coarse_triangles(skin, 0.1).triangles;
  EXPECT_EQ(visible_sides(skin), Sides::kFront);
}

// Both faces of the plate lie in the same cells.
TEST(CoarseTriangles, AThinPartKeepsItsFaces) {
  const Skin skin = make_box_skin({-0.5, 0, -0.5}, {0.5, 0.01, 0.5});
  const CoarseTriangles coarse = coarse_triangles(skin, 0.1);
  EXPECT_NEAR(volume(skin, coarse.triangles), 0.01, 1e-9);
}

TEST(CoarseTriangles, KnowWhichTrianglesTheyComeFrom) {
  const Skin skin = ball();
  const CoarseTriangles coarse = coarse_triangles(skin, 0.1);
  ASSERT_EQ(coarse.first.size(), skin.triangles.rows() + 1);
  EXPECT_EQ(coarse.first.front(), 0);
  EXPECT_EQ(coarse.first.back(), coarse.triangles.rows());
  for (std::size_t t = 0; t + 1 < coarse.first.size(); ++t) {
    const int count = coarse.first[t + 1] - coarse.first[t];
    ASSERT_TRUE(count == 0 || count == 1) << t;
  }
}

TEST(VisibleSides, AreOneForASolidAndBothForASheet) {
  Skin skin = ball();
  EXPECT_EQ(visible_sides(skin), Sides::kFront);
  skin.triangles.col(1).swap(skin.triangles.col(2));
  EXPECT_EQ(visible_sides(skin), Sides::kBack);
  skin.triangles.conservativeResize(skin.triangles.rows() - 20, 3);
  EXPECT_EQ(visible_sides(skin), Sides::kBoth);
  EXPECT_EQ(visible_sides(Skin{}), Sides::kBoth);
}

}  // namespace
}  // namespace sprung
