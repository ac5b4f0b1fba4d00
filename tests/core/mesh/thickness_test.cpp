#include "core/mesh/query/thickness.h"

#include <gtest/gtest.h>

#include "core/bricks/thin_parts.h"
#include "core/bricks/voxelize.h"
#include "core/mesh/io/read_mesh.h"
#include "tests/support/comb.h"

namespace sprung {
namespace {

Solid only(const SurfaceMesh& mesh) { return find_solids(mesh, "test").solids.at(0); }

TEST(Thickness, OfABoxIsItsSides) {
  const Solid solid = only(test::box_mesh(Vec3(1, 2, 3), Vec3(2, 4, 7)));
  const std::vector<WallSample> samples = sample_thickness(solid, 1000);
  ASSERT_EQ(samples.size(), 1000U);
  for (const WallSample& sample : samples) {
    EXPECT_NEAR(sample.thickness, std::abs(sample.outward.dot(Vec3(1, 2, 4))), 1e-9);
  }
  // Of the surface of 28, 16 bound the side of 1, 8 that of 2 and 4 that of 4.
  EXPECT_NEAR(thickness_quantile({samples}, 0.56), 1, 1e-9);
  EXPECT_NEAR(thickness_quantile({samples}, 0.58), 2, 1e-9);
  EXPECT_NEAR(thickness_quantile({samples}, 0.87), 4, 1e-9);
  EXPECT_NEAR(surface_area(solid), 28, 1e-9);
}

/// A block of 4 x 2 x 4 with a fin of 0.3 x 5 x 4 on it.
SurfaceMesh block_with_fin() { return test::comb_mesh({{0, 0.3}, {4, 4.3}}, 2, 5, 4); }

TEST(ThinParts, AreTheFinsAndNotTheEdgesOfTheBlock) {
  const Solid solid = only(block_with_fin());
  const BrickGrid grid = voxelize(solid, 1);
  const std::vector<ThinPart> parts = find_thin_parts(grid, sample_thickness(solid, 5000));
  ASSERT_EQ(parts.size(), 2U);
  for (const ThinPart& part : parts) {
    EXPECT_NEAR(part.thickness, 0.3, 1e-9);
    EXPECT_GT(part.position.y(), 1);
    for (const int brick : part.bricks) EXPECT_GE(grid.cells[brick].y(), 1);
  }
  EXPECT_TRUE(find_thin_parts(voxelize(solid, 0.25), sample_thickness(solid, 5000)).empty());
  const Solid ball = only(test::torus_mesh(3, 1.5));
  EXPECT_TRUE(find_thin_parts(voxelize(ball, 0.5), sample_thickness(ball, 5000)).empty());
}

TEST(ThinParts, AreHeldByBricksOfTheSizeNamed) {
  // A blade of 1 x 1 at its root that tapers to 0.2.
  SurfaceMesh mesh = test::box_mesh(Vec3(0, 0, 0), Vec3(10, 1, 1));
  for (int v = 0; v < 8; ++v) {
    if (mesh.positions(v, 0) > 0) mesh.positions(v, 2) = mesh.positions(v, 2) > 0 ? 0.6 : 0.4;
  }
  const Solid solid = only(mesh);
  const std::vector<WallSample> samples = sample_thickness(solid, 20000);
  const std::vector<ThinPart> parts = find_thin_parts(voxelize(solid, 0.5), samples);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_GT(parts[0].thickness, 0.15);
  EXPECT_LT(parts[0].thickness, 0.35);
  EXPECT_GT(parts[0].position.x(), 8);
  EXPECT_TRUE(find_thin_parts(voxelize(solid, 0.8 * parts[0].thickness), samples).empty());
}

TEST(BrickSize, FollowsThinPartsTheShapeOrTheBudget) {
  const auto choose = [](const SurfaceMesh& mesh, double longest, double budget) {
    const std::vector<Solid> solids = find_solids(mesh, "test").solids;
    return choose_brick_size(solids, sample_thickness(solids, 4000), longest, budget);
  };
  const BrickChoice fins = choose(block_with_fin(), 7, kBrickBudget);
  EXPECT_EQ(fins.reason, BrickChoice::Reason::kThickness);
  EXPECT_NEAR(fins.size, 0.15, 1e-9);
  const BrickChoice block = choose(test::box_mesh(Vec3::Zero(), Vec3(4, 3, 3)), 4, kBrickBudget);
  EXPECT_EQ(block.reason, BrickChoice::Reason::kShape);
  EXPECT_NEAR(block.size, 4.0 / 12, 1e-9);
  const BrickChoice few = choose(block_with_fin(), 7, 3000);
  EXPECT_EQ(few.reason, BrickChoice::Reason::kBudget);
  const int bricks = voxelize(only(block_with_fin()), few.size).brick_count();
  EXPECT_LT(bricks, 3000 * 1.1);
  EXPECT_GT(bricks, 3000 * 0.5);
}

}  // namespace
}  // namespace sprung
