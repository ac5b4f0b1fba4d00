#include "core/bricks/slivers.h"

#include <gtest/gtest.h>

#include "core/bricks/embedding.h"
#include "core/bricks/fill_solid.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

/// A row of bricks along x with these fills.
BrickGrid row(const std::vector<double>& fills) {
  BrickGrid grid = make_box_grid({isize(fills), 1, 1}, 0.1);
  grid.fill = fills;
  return grid;
}

TEST(Slivers, GoToTheirFullNeighbourWithTheirVolume) {
  BrickGrid grid = row({1, 1, 0.05});
  const double volume = grid.volume();
  EXPECT_EQ(absorb_slivers(grid), 1);
  ASSERT_EQ(grid.brick_count(), 2);
  EXPECT_EQ(grid.node_count(), 12);
  EXPECT_DOUBLE_EQ(grid.fill[1], 1.05);
  EXPECT_NEAR(grid.volume(), volume, 1e-18);
}

TEST(Slivers, ThinPartsStayOnTheBody) {
  BrickGrid fin = row({1, 0.05, 0.06, 0.04});
  EXPECT_EQ(absorb_slivers(fin), 0);
  BrickGrid sheet = row({0.05, 0.05, 0.05});
  EXPECT_EQ(absorb_slivers(sheet), 0);
}

TEST(Slivers, ABrickThatIsCutInHalfStays) {
  BrickGrid grid = row({1, 0.5});
  EXPECT_EQ(absorb_slivers(grid), 0);
}

/// Two specks in a chain that hangs by one edge of a thin part.
TEST(Slivers, SpecksGoToThePartAtWhichTheyHang) {
  BrickGrid grid;
  grid.brick_size = 0.1;
  grid.cells = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  number_nodes(grid);
  grid.fill = {0.4, 0.3, 1e-4, 1e-4};
  const double volume = grid.volume();
  EXPECT_EQ(absorb_slivers(grid), 2);
  ASSERT_EQ(grid.brick_count(), 2);
  EXPECT_DOUBLE_EQ(grid.fill[1], 0.3002);
  EXPECT_NEAR(grid.volume(), volume, 1e-18);
}

/// A box a little larger than whole bricks, whose edges are chains of specks: its surface follows neighbouring bricks.
TEST(Slivers, ChainsOfSpecksDoNotAllGoToOneBrick) {
  const Vec3 high(11.015, 30.15, 20.08);
  const Solids solids = find_solids(test::box_mesh(Vec3::Zero(), high), "box");
  const FilledSolid filled = fill_solid(solids.solids.at(0), 1);
  EXPECT_GT(filled.slivers, 20);
  Points points(3 * 121, 3);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= 120; ++i) {
      Vec3 position = high;
      position[axis] *= i / 120.0;
      points.row(121 * axis + i) = position.transpose();
    }
  }
  const Embedding embedding = embed(filled.grid, points);
  EXPECT_LT(embedding.local.maxCoeff(), 2.01);
  EXPECT_GT(embedding.local.minCoeff(), -1.01);
}

TEST(Slivers, ASpeckThatLinksTwoPartsStays) {
  BrickGrid grid = row({0.4, 1e-4, 0.3});
  EXPECT_EQ(absorb_slivers(grid), 0);
  BrickGrid alone = row({1e-4, 1e-4});
  EXPECT_EQ(absorb_slivers(alone), 0);
}

/// A brick that hangs by an edge is free to turn about it; one that hangs by two edges is not.
TEST(Slivers, WhatHangsByAHingeGoesToTheBody) {
  BrickGrid grid = make_box_grid({5, 5, 5}, 0.1);
  grid.cells.emplace_back(5, 5, 4);  // the last in order
  number_nodes(grid);
  grid.fill.assign(grid.cells.size(), 1);
  grid.fill.back() = 0.7;
  const double volume = grid.volume();
  EXPECT_EQ(absorb_slivers(grid), 1);
  EXPECT_EQ(grid.brick_count(), 125);
  EXPECT_NEAR(grid.volume(), volume, 1e-15);
  // Next to a missing corner: held by three edges.
  BrickGrid bridge = make_box_grid({6, 6, 6}, 0.1);
  std::erase_if(bridge.cells, [](const Eigen::Vector3i& cell) {
    return (cell.x() > 3 && cell.y() > 3) && cell != Eigen::Vector3i(4, 4, 2);
  });
  number_nodes(bridge);
  bridge.fill.assign(bridge.cells.size(), 1);
  EXPECT_EQ(absorb_slivers(bridge), 0);
}

TEST(Slivers, AChainOfHingesGoesFromItsEnd) {
  BrickGrid grid = make_box_grid({7, 7, 7}, 0.1);
  for (const int step : {7, 8, 9}) grid.cells.emplace_back(step, step, 6);
  number_nodes(grid);
  grid.fill.assign(grid.cells.size(), 0.5);
  EXPECT_EQ(absorb_slivers(grid), 3);
  EXPECT_EQ(grid.brick_count(), 343);
  EXPECT_NEAR(grid.volume(), 346 * 0.5 * 1e-3, 1e-12);
}

/// A piece of that size is a part, and the supports have to hold it.
TEST(Slivers, ALargePartThatHangsByAHingeStays) {
  BrickGrid grid;
  grid.brick_size = 0.1;
  grid.cells = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  number_nodes(grid);
  grid.fill = {1, 1, 1, 1};
  EXPECT_EQ(absorb_slivers(grid), 0);
}

/// A thin part has no full brick, but bricks that are nearly empty next to others.
TEST(LooseBricks, GoToTheFullestFaceNeighbourOfAThinPart) {
  BrickGrid grid = row({0.3, 0.25, 0.02});
  EXPECT_EQ(absorb_slivers(grid), 0);
  const double volume = grid.volume();
  EXPECT_EQ(absorb_loose_bricks(grid), 1);
  ASSERT_EQ(grid.brick_count(), 2);
  EXPECT_DOUBLE_EQ(grid.fill[1], 0.27);
  EXPECT_NEAR(grid.volume(), volume, 1e-18);
  BrickGrid even = row({0.05, 0.05, 0.04});
  EXPECT_EQ(absorb_loose_bricks(even), 0);
}

TEST(LooseBricks, StayWhereTheirNeighboursHangTogetherByThem) {
  BrickGrid link = row({0.4, 0.01, 0.3});
  EXPECT_EQ(absorb_loose_bricks(link), 0);
  // Round a corner: without both of the others the first and the last would share an edge, a hinge.
  BrickGrid corner = make_box_grid({2, 2, 1}, 0.1);
  corner.fill = {0.4, 0.02, 0.01, 0.4};
  EXPECT_EQ(absorb_loose_bricks(corner), 1);
  ASSERT_EQ(corner.brick_count(), 3);
  EXPECT_DOUBLE_EQ(corner.fill[1], 0.02);
}

}  // namespace
}  // namespace sprung
