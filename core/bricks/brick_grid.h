#pragma once
#include <array>
#include <vector>

#include "core/types.h"

namespace sprung {

/// The bricks of one body: the cells of a cubic lattice that hold solid, and the nodes at their corners.
/// Corner c of a brick lies at cell + (c & 1, c >> 1 & 1, c >> 2 & 1): x runs fastest.
struct BrickGrid {
  Vec3 origin = Vec3::Zero();          // corner of cell (0, 0, 0), m, in the body's rest frame
  double brick_size = 0;               // side h, m
  std::vector<Eigen::Vector3i> cells;  // n; ordered by z, then y, then x
  std::vector<double> fill;            // n; solid in the brick over its volume, in (0, 1], a little more at slivers.h
  std::vector<std::array<int, 8>> nodes;  // n; rows of lattice, by corner
  std::vector<Eigen::Vector3i> lattice;   // m; lattice coordinates of each node, ordered by z, then y, then x

  [[nodiscard]] int brick_count() const { return static_cast<int>(cells.size()); }
  [[nodiscard]] int node_count() const { return static_cast<int>(lattice.size()); }
  [[nodiscard]] double brick_volume() const { return brick_size * brick_size * brick_size; }
  /// Volume of the solid in the bricks: sum of fill h^3, m^3.
  [[nodiscard]] double volume() const;
  /// m x 3, metres.
  [[nodiscard]] Points rest_positions() const;
};

/// Every cell of a box of counts x, y, z, completely filled, its low corner at the origin.
[[nodiscard]] BrickGrid make_box_grid(const Eigen::Vector3i& counts, double brick_size);

/// Fills in the nodes of a grid whose cells are set, in their order and each once: neighbours share the corners that
/// coincide. Cost: linear in the cells.
void number_nodes(BrickGrid& grid);

}  // namespace sprung
