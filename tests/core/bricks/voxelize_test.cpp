#include "core/bricks/voxelize.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/sanitized.h"

namespace sprung {
namespace {

using test::box_mesh;
using test::torus_mesh;

Solid solid_of(const SurfaceMesh& mesh) { return find_solids(mesh, "test").solids.at(0); }

double longest_side(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

double fill_at(const BrickGrid& grid, const Eigen::Vector3i& cell) {
  const auto found = std::find(grid.cells.begin(), grid.cells.end(), cell);
  return found == grid.cells.end() ? 0 : grid.fill[found - grid.cells.begin()];
}

bool all_full(const BrickGrid& grid) {
  return std::all_of(grid.fill.begin(), grid.fill.end(), [](double fill) { return fill == 1; });
}

TEST(Voxelize, GridAlignedBoxIsExactlyItsCells) {
  for (const int n : {1, 2, 3, 7, 10, 24, 49}) {
    for (const double side : {1.0, 0.1, 1e-6, 3e7}) {
      const Solid solid = solid_of(box_mesh(Vec3::Constant(-0.37 * side), Vec3::Constant(0.63 * side)));
      const BrickGrid grid = voxelize(solid, side / n);
      EXPECT_EQ(grid.brick_count(), n * n * n) << n << " bricks a side of " << side;
      EXPECT_TRUE(all_full(grid));
      EXPECT_EQ(grid.node_count(), (n + 1) * (n + 1) * (n + 1));
    }
  }
}

TEST(Voxelize, BeamOfFloatCornersGetsNoExtraLayer) {
  // As 0.4 x 0.1 x 0.1 m is stored by a file in single precision.
  const BrickGrid grid = voxelize(solid_of(box_mesh(Vec3::Zero(), Vec3(0.4F, 0.1F, 0.1F))), 0.0125);
  EXPECT_EQ(grid.brick_count(), 32 * 8 * 8);
  EXPECT_TRUE(all_full(grid));
}

TEST(Voxelize, CutLayersHaveTheirShare) {
  const BrickGrid grid = voxelize(solid_of(box_mesh(Vec3::Zero(), Vec3(2.5, 3.3, 4))), 1);
  EXPECT_EQ(grid.brick_count(), 3 * 4 * 4);
  EXPECT_NEAR(grid.volume(), 2.5 * 3.3 * 4, 1e-12);
  EXPECT_DOUBLE_EQ(fill_at(grid, {1, 1, 1}), 1);
  EXPECT_NEAR(fill_at(grid, {2, 1, 1}), 0.5, 2e-3);
  EXPECT_NEAR(fill_at(grid, {1, 3, 3}), 0.3, 2e-3);
  EXPECT_NEAR(fill_at(grid, {2, 3, 1}), 0.15, 1e-2);
}

TEST(Voxelize, WallsThinnerThanARayPitchAreNotLost) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 high = Vec3::Constant(10);
    high[axis] = 0.01;
    const BrickGrid grid = voxelize(solid_of(box_mesh(Vec3::Zero(), high)), 1);
    EXPECT_EQ(grid.brick_count(), 100) << "axis " << axis;
    EXPECT_NEAR(grid.volume(), 1, 1e-9);
  }
}

TEST(Voxelize, HolesAndCavitiesStayOpen) {
  const BrickGrid torus = voxelize(solid_of(torus_mesh(2, 0.5)), 5.0 / 32);
  const Eigen::Vector3i centre(16, 16, 3);
  EXPECT_EQ(fill_at(torus, centre), 0);
  EXPECT_EQ(fill_at(torus, centre + Eigen::Vector3i(13, 0, 0)), 1);
  const SurfaceMesh hollow = test::joined(box_mesh(Vec3::Zero(), Vec3::Constant(6)),
                                          test::inside_out(box_mesh(Vec3::Constant(2), Vec3::Constant(4))));
  EXPECT_EQ(voxelize(solid_of(hollow), 1).brick_count(), 216 - 8);
}

TEST(Voxelize, AnOverlapCountsOnce) {
  // One solid whose two lobes run through each other, joined only for this test: two boxes as one list of triangles.
  const SurfaceMesh both = test::joined(box_mesh(Vec3::Zero(), Vec3(4, 2, 2)), box_mesh(Vec3(2, 0, 0), Vec3(6, 2, 2)));
  const Solid solid{both.positions, both.triangles, {}, {}, 32};
  const BrickGrid grid = voxelize(solid, 1);
  EXPECT_EQ(grid.brick_count(), 24);
  EXPECT_DOUBLE_EQ(grid.volume(), 24);
}

TEST(Voxelize, SamplesAreExactEnoughWithoutTheSolidsVolume) {
  // A volume that is off by more than sampling can be is not matched, so this sees the raw samples.
  SurfaceMesh mesh = torus_mesh(2, 0.5);
  mesh.positions *= Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Solid solid = solid_of(mesh);
  const double volume = solid.volume;
  solid.volume = 10 * volume;
  for (const auto& [size, error] : {std::pair{0.5, 3e-3}, {0.25, 1e-3}, {0.125, 2e-4}}) {
    EXPECT_NEAR(voxelize(solid, size).volume() / volume, 1, error) << size;
  }
}

TEST(Voxelize, IsDeterministic) {
  const Solid solid = solid_of(torus_mesh(2, 0.5));
  const BrickGrid a = voxelize(solid, 0.1);
  const BrickGrid b = voxelize(solid, 0.1);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.fill, b.fill);
  EXPECT_EQ(a.nodes, b.nodes);
}

TEST(Voxelize, SizeAndPlaceDoNotMatter) {
  const SurfaceMesh mesh = torus_mesh(2, 0.5);
  const BrickGrid expected = voxelize(solid_of(mesh), 0.1);
  for (const auto& [scale, shift] : {std::pair{1e-6, 0.0}, {1e6, 0.0}, {1.0, 5e6}, {1.0, -5e6}}) {
    SurfaceMesh moved = mesh;
    moved.positions = (moved.positions.array() * scale + shift).matrix();
    const BrickGrid grid = voxelize(solid_of(moved), 0.1 * scale);
    ASSERT_EQ(grid.cells, expected.cells) << "scale " << scale << ", shift " << shift;
    for (std::size_t i = 0; i < grid.fill.size(); ++i) EXPECT_NEAR(grid.fill[i], expected.fill[i], 1e-2);
  }
}

TEST(Voxelize, RefusesMoreCellsThanItCanCount) {
  const Solid solid = solid_of(box_mesh(Vec3::Zero(), Vec3::Ones()));
  EXPECT_THROW((void)voxelize(solid, 1e-5), Error);
  EXPECT_THROW((void)voxelize(solid, 1e-300), Error);
  EXPECT_THROW((void)voxelize(solid, 0.7e-3), Error);
}

TEST(Voxelize, AMillionBricksTakeSeconds) {
  const Solid solid = solid_of(torus_mesh(2, 1, 192, 96));
  const auto start = std::chrono::steady_clock::now();
  const BrickGrid grid = voxelize(solid, 0.034);
  EXPECT_GT(grid.brick_count(), 950000);
  const std::chrono::seconds most(test::kSanitized ? 300 : 20);
  EXPECT_LT(std::chrono::steady_clock::now() - start, most) << "even on a busy machine, unoptimised";
}

class ModelVolumes : public ::testing::TestWithParam<const char*> {};

TEST_P(ModelVolumes, AreKeptAt32Bricks) {
  const auto file = test::model(GetParam());
  const SurfaceMesh mesh = read_mesh(file);
  const double size = longest_side(mesh.positions) / 32;
  double volume = 0;
  double bricks = 0;
  for (const Solid& solid : find_solids(mesh, GetParam()).solids) {
    const BrickGrid grid = voxelize(solid, size);
    volume += solid.volume;
    bricks += grid.volume();
    for (const double fill : grid.fill) {
      ASSERT_GT(fill, 0);
      ASSERT_LE(fill, 1);
    }
  }
  EXPECT_NEAR(bricks / volume, 1, 0.005);
}

INSTANTIATE_TEST_SUITE_P(All, ModelVolumes,
                         ::testing::Values("bear.ply", "bracket.stl", "gripper.ply", "gummy.ply", "jelly.ply",
                                           "knot.ply", "octopus.ply", "pudding.ply", "tentacle.ply", "torus.ply",
                                           "wheel.ply"));

TEST(Voxelize, UnitCubeIsExactlyItsBricks) {
  const Solid solid = solid_of(test::box_mesh(Vec3::Zero(), Vec3::Ones()));
  for (int n = 1; n <= 40; ++n) {
    const BrickGrid grid = voxelize(solid, 1.0 / n);
    EXPECT_EQ(grid.brick_count(), n * n * n);
    EXPECT_TRUE(all_full(grid)) << n;
  }
}

}  // namespace
}  // namespace sprung
