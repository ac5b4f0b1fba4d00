#include <gtest/gtest.h>

#include "core/bricks/pieces.h"

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

TEST(Slivers, ASpeckThatLinksTwoPartsStays) {
  BrickGrid grid = row({0.4, 1e-4, 0.3});
  EXPECT_EQ(absorb_slivers(grid), 0);
  BrickGrid alone = row({1e-4, 1e-4});
  EXPECT_EQ(absorb_slivers(alone), 0);
}

}  // namespace
}  // namespace sprung
