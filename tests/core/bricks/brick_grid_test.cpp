#include "core/bricks/brick_grid.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>

namespace sprung {
namespace {

std::tuple<int, int, int> zyx(const Eigen::Vector3i& p) { return {p.z(), p.y(), p.x()}; }

TEST(BrickGrid, BoxHasEveryCellAndNode) {
  const BrickGrid grid = make_box_grid({4, 3, 2}, 0.5);
  EXPECT_EQ(grid.brick_count(), 24);
  EXPECT_EQ(grid.node_count(), 5 * 4 * 3);
  EXPECT_DOUBLE_EQ(grid.volume(), 24 * 0.125);
  const Points rest = grid.rest_positions();
  EXPECT_EQ(rest.row(0), Eigen::RowVector3d(0, 0, 0));
  EXPECT_EQ(rest.row(1), Eigen::RowVector3d(0.5, 0, 0)) << "x runs fastest";
  EXPECT_EQ(rest.row(59), Eigen::RowVector3d(2, 1.5, 1));
}

/// Scattered cells, far apart and negative too: the nodes must be the set of corners, in order, each corner its own.
TEST(BrickGrid, NodesAreTheDistinctCornersInOrder) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> near(-3, 3);
  std::set<std::tuple<int, int, int>> chosen;
  for (int i = 0; i < 120; ++i) chosen.emplace(near(random), near(random), near(random));
  chosen.emplace(900000, -900000, 800000);
  BrickGrid grid;
  grid.brick_size = 1;
  for (const auto& [z, y, x] : chosen) grid.cells.emplace_back(x, y, z);
  grid.fill.assign(grid.cells.size(), 1.0);
  number_nodes(grid);

  std::set<std::tuple<int, int, int>> corners;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i expected = grid.cells[i] + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      corners.insert(zyx(expected));
      const int node = grid.nodes[i][corner];
      ASSERT_EQ(grid.lattice.at(node), expected);
    }
  }
  ASSERT_EQ(grid.lattice.size(), corners.size());
  auto next = corners.begin();
  for (const Eigen::Vector3i& point : grid.lattice) EXPECT_EQ(zyx(point), *next++);
}

TEST(BrickGrid, EmptyGridHasNoNodes) {
  BrickGrid grid;
  number_nodes(grid);
  EXPECT_EQ(grid.node_count(), 0);
  EXPECT_EQ(grid.volume(), 0);
}

}  // namespace
}  // namespace sprung
