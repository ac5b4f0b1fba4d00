#include <gtest/gtest.h>

#include "core/bricks/voxelize.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/query/self_intersections.h"
#include "core/mesh/query/thickness.h"
#include "core/mesh/repair/solids.h"
#include "tests/external/external_mesh.h"

namespace sprung {
namespace {

class ExternalThickness : public ::testing::TestWithParam<std::tuple<const char*, double, double>> {};

TEST_P(ExternalThickness, IsThatOfTheTable) {
  const auto [name, thin, median] = GetParam();
  const auto file = test::external_mesh(name);
  const SurfaceMesh mesh = read_mesh(file);
  const std::vector<std::vector<WallSample>> walls = sample_thickness(find_solids(mesh, name).solids, 20000);
  const double longest = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
  // The table is from 3,000 random points: its 1st percentile is from 30 of them.
  EXPECT_NEAR(100 * thickness_quantile(walls, 0.01) / longest, thin, 0.2 * thin + 0.05);
  EXPECT_NEAR(100 * thickness_quantile(walls, 0.5) / longest, median, 0.05 * median + 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, ExternalThickness,
                         ::testing::Values(std::tuple("spot_triangulated.obj", 6.4, 42.9),
                                           std::tuple("bunny.obj", 2.8, 52.0), std::tuple("eight.off", 11.9, 14.1),
                                           std::tuple("scorpion_low_resolution.obj", 1.2, 6.0),
                                           std::tuple("cube_gears.3mf", 0.4, 6.6), std::tuple("Duck.glb", 4.1, 53.4),
                                           std::tuple("plate_holes.STL", 3.5, 4.2),
                                           std::tuple("huesitos.fbx", 1.9, 34.0)));

TEST(ExternalCrossings, AreManyAsAnotherProgramCounts) {
  const auto file = test::external_mesh("self_intersectA.obj");
  const Solids found = find_solids(read_mesh(file), "band");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(find_self_intersections(found.solids[0].points, found.solids[0].triangles).size(), 338U);
}

TEST(ExternalVolume, OfASurfaceThroughItselfIsThatOfTheUnion) {
  const auto file = test::external_mesh("self_intersectA.obj");
  const Solid solid = find_solids(read_mesh(file), "band").solids.at(0);
  const double longest = (solid.points.colwise().maxCoeff() - solid.points.colwise().minCoeff()).maxCoeff();
  const double fine = voxelize(solid, longest / 160).volume();
  EXPECT_LT(fine, 0.97 * solid.volume) << "the overlap is counted twice";
  EXPECT_NEAR(voxelize(solid, longest / 32).volume() / fine, 1, 0.005);
}

}  // namespace
}  // namespace sprung
