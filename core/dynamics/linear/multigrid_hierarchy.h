#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/dynamics/linear/multigrid_kernels.h"

namespace sprung::multigrid {

/// The interpolation of a level's nodes from those of the next coarser one: the mean of 1, 2, 4 or 8 of them, for nodes
/// on a corner, an edge, a face or in the middle of a coarse brick.
struct Interpolation {
  std::vector<std::array<int, 8>> coarse_nodes;  // by fine node
  std::vector<std::uint8_t> counts;              // how many of them count
  std::vector<int> first_fine;                   // by coarse node: the fine nodes interpolated from it ...
  std::vector<int> fine_nodes;
};

/// One level of bricks, and how it is derived from the finer one.
struct Layout {
  std::vector<Eigen::Vector3i> cells;
  std::vector<BrickNodes> bricks;
  int node_count = 0;
  CornerLists corners;
  std::vector<Children> children;  // of the finer level; empty on the finest
  Interpolation to_coarse;         // empty on the coarsest
};

/// Which level is coarse enough to be the last: one within both limits.
struct LastLevel {
  int max_nodes = 0;
  double max_flops = std::numeric_limits<double>::max();  // of its Cholesky factorization
};

/// The grid's own bricks, then ever coarser ones of two by two by two, down to `last` or to bricks that have nothing
/// left to join. A coarse brick joins only children that are connected by their nodes: where a gap runs through a cell
/// it holds several bricks, and bricks share a coarse node only where their children share a node. So the parts of a
/// body that a gap divides stay free of each other on every level.
[[nodiscard]] std::vector<Layout> make_hierarchy(const BrickGrid& grid, const LastLevel& last);

}  // namespace sprung::multigrid
