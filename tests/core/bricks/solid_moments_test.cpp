#include "core/bricks/solid_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bricks/fill_solid.h"
#include "core/bricks/pieces.h"
#include "core/bricks/voxelize.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::box_mesh;

Solid only_solid(const SurfaceMesh& mesh) { return find_solids(mesh, "test").solids.at(0); }

/// The bricks of a box of the lattice, in which the solid may lie anywhere.
BrickGrid bricks_around(const Solid& solid, const Eigen::Vector3i& counts) {
  BrickGrid grid = make_box_grid(counts, 1);
  split_pieces(solid, grid);
  grid.moments = solid_moments(grid);
  return grid;
}

SolidMoments moments_of_box(const Vec3& low, const Vec3& high) {
  const Vec3 square = (high - low).cwiseAbs2() / 12;
  return {.centroid = (low + high) / 2 - Vec3::Constant(0.5), .covariance = square.asDiagonal()};
}

TEST(SolidMoments, ArePlatesToTheLastDigit) {
  for (const double thickness : {0.02, 0.1, 0.2, 0.25, 0.35, 0.5, 0.67, 0.9}) {
    for (const double share : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      const double low = share * (1 - thickness);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 from(-1, -1, -1);
        Vec3 to(4, 4, 4);
        from[axis] = low + 1;
        to[axis] = low + 1 + thickness;
        const Solid plate = only_solid(box_mesh(from.cwiseMax(0), to.cwiseMin(3)));
        const BrickGrid grid = bricks_around(plate, {3, 3, 3});
        const auto middle = std::find(grid.cells.begin(), grid.cells.end(), Eigen::Vector3i(1, 1, 1));
        ASSERT_NE(middle, grid.cells.end());
        const SolidMoments& found = grid.moments[middle - grid.cells.begin()];
        Vec3 inner_low = Vec3::Zero();
        Vec3 inner_high = Vec3::Ones();
        inner_low[axis] = low;
        inner_high[axis] = low + thickness;
        const SolidMoments expected = moments_of_box(inner_low, inner_high);
        EXPECT_LT((found.centroid - expected.centroid).norm(), 1e-4) << thickness << ' ' << low;
        const Mat3 error = found.covariance - expected.covariance;
        EXPECT_LT(std::abs(error(axis, axis)), 1e-3 * expected.covariance(axis, axis)) << thickness << ' ' << low;
        EXPECT_LT(error.norm(), 1e-4);
      }
    }
  }
}

TEST(SolidMoments, AreNearlyThoseOfRodsAndCorners) {
  for (const double width : {0.3, 0.45, 0.55, 0.8}) {
    for (const double low : {0.0, 0.07, 0.15}) {
      const Vec3 from(0, low, low);
      const Vec3 to(3, low + width, low + width);
      const BrickGrid rod = bricks_around(only_solid(box_mesh(from, to)), {3, 1, 1});
      const SolidMoments expected = moments_of_box({0, low, low}, {1, low + width, low + width});
      EXPECT_LT((rod.moments[1].centroid - expected.centroid).norm(), 0.01);
      EXPECT_LT((rod.moments[1].covariance - expected.covariance).norm(), 0.03 * expected.covariance.norm());
      const BrickGrid corner = bricks_around(only_solid(box_mesh({low, low, low}, {2, 2, 2})), {2, 2, 2});
      const SolidMoments of_corner = moments_of_box({low, low, low}, {1, 1, 1});
      EXPECT_LT((corner.moments[0].centroid - of_corner.centroid).norm(), 0.005);
      EXPECT_LT((corner.moments[0].covariance - of_corner.covariance).norm(), 0.02 * of_corner.covariance.norm());
    }
  }
}

TEST(SolidMoments, AreThoseOfInclinedPlates) {
  for (const double degrees : {3.0, 10.0, 25.0, 45.0}) {
    for (const double thickness : {0.25, 0.5}) {
      SurfaceMesh mesh = box_mesh({-6, -6, -thickness / 2}, {6, 6, thickness / 2});
      const Mat3 turn = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3(0.3, 1, 0).normalized()).matrix();
      mesh.positions = ((mesh.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(6.5, 6.5, 6.5)).eval();
      const BrickGrid grid = bricks_around(only_solid(mesh), {13, 13, 13});
      const auto middle = std::find(grid.cells.begin(), grid.cells.end(), Eigen::Vector3i(6, 6, 6));
      const SolidMoments& found = grid.moments[middle - grid.cells.begin()];
      // Points of the cell, many and fine.
      SolidIntegrals sum;
      constexpr int kFine = 120;
      for (int i = 0; i < kFine * kFine * kFine; ++i) {
        const Vec3 position = (Vec3(i % kFine, i / kFine % kFine, i / kFine / kFine).array() + 0.5) / kFine - 0.5;
        if (std::abs(turn.col(2).dot(position)) < thickness / 2) sum += integrals_of(1, {position, Mat3::Zero()});
      }
      const SolidMoments expected = sum.moments();
      EXPECT_LT((found.centroid - expected.centroid).norm(), 5e-3) << degrees << ' ' << thickness;
      EXPECT_LT((found.covariance - expected.covariance).norm(), 0.03 * expected.covariance.norm())
          << degrees << ' ' << thickness;
      const Vec3 normal = turn.col(2);
      EXPECT_NEAR(normal.dot(found.covariance * normal) / (thickness * thickness / 12), 1, 0.1)
          << degrees << ' ' << thickness;
    }
  }
}

TEST(SolidMoments, AreThoseOfTheWholeMesh) {
  const Solid torus = only_solid(test::torus_mesh(2, 0.7));
  for (const double size : {0.2, 0.45, 0.9}) {
    const BrickGrid grid = fill_solid(torus, size).grid;
    ASSERT_EQ(grid.moments.size(), grid.cells.size());
    SolidIntegrals sum;
    for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
      const Vec3 middle = brick_middle(grid, int(brick)) / size;
      sum += integrals_of(grid.fill[brick], grid.moments[brick]).moved(middle);
      EXPECT_LT(grid.fill[brick] == 1 ? grid.moments[brick].centroid.norm() : 0, 2e-3);
    }
    const SolidMoments found = sum.moments();
    // pi^2 2 R r^2 of radius R + r cos b: <z^2> = r^2 / 4, <x^2> = (R^2 + 3/4 r^2) / 2.
    EXPECT_LT(found.centroid.norm() * size, 5e-3);
    EXPECT_NEAR(found.covariance(2, 2) * size * size, 0.49 / 4, 0.001);
    EXPECT_NEAR(found.covariance(0, 0) * size * size, (4 + 0.75 * 0.49) / 2, 0.005);
  }
}

TEST(Fill, FullBricksStayFullWhereSpecksAreDropped) {
  const SurfaceMesh mesh =
      test::joined(box_mesh(Vec3::Zero(), Vec3::Constant(5.3)), box_mesh(Vec3(9, 1, 1), Vec3(9.2, 1.2, 1.2)));
  BrickGrid grid = voxelize({mesh.positions, mesh.triangles, {}, {}, std::pow(5.3, 3) + 0.008}, 1);
  const double before = grid.volume();
  const Solid solid{mesh.positions, mesh.triangles, {}, {}, before};
  EXPECT_EQ(split_pieces(solid, grid).dropped, 1);
  EXPECT_NEAR(grid.volume() / before, 1, 1e-12);
  EXPECT_EQ(std::count(grid.fill.begin(), grid.fill.end(), 1.0), 125);
}

}  // namespace
}  // namespace sprung
