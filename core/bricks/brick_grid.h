#pragma once
#include <array>
#include <bitset>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/types.h"

namespace sprung {

/// The solid of one brick within one cell, where the surface cuts the cell. The brick is usually at that cell; solid
/// that was given to a neighbour (slivers.h) rides in a brick beside it.
struct SolidPatch {
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();
  int brick = 0;
  std::bitset<512> samples;            // bit x + 8 y + 64 z: the middle of that eighth of the cell along each axis
  std::vector<Eigen::Vector3f> spots;  // of solid too thin for those, in [0, 1] along each axis of the cell
};

/// The bricks of one body: the cells of a cubic lattice that hold solid, and the nodes at their corners.
/// Corner c of a brick lies at cell + (c & 1, c >> 1 & 1, c >> 2 & 1): x runs fastest.
/// Where a cell holds several pieces of solid that do not hang together in it (two fingers) there is a brick for each
/// piece: the cell then comes several times, one row after the other. Bricks share nodes only where solid runs from one
/// to the next through a face (see pieces.h), so a lattice point may come several times as well, one row after the
/// other; every node is at one lattice point.
struct BrickGrid {
  Vec3 origin = Vec3::Zero();          // corner of cell (0, 0, 0), m, in the body's rest frame
  double brick_size = 0;               // side h, m
  std::vector<Eigen::Vector3i> cells;  // n; ordered by z, then y, then x
  std::vector<double> fill;            // n; solid in the brick over its volume, in (0, 1], a little more at slivers.h
  std::vector<std::array<int, 8>> nodes;  // n; rows of lattice, by corner
  std::vector<Eigen::Vector3i> lattice;   // m; lattice coordinates of each node, ordered by z, then y, then x
  std::vector<SolidPatch> patches;        // of the cells that the surface cuts, ordered as cells; empty: not looked for

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

/// The same for cells that may come several times: `corners` says which of the bricks' corners (8 brick + corner) are
/// one node; only corners at the same lattice point may be.
void number_nodes(BrickGrid& grid, DisjointSets& corners);

/// Takes the bricks out for which `gone` (n) is set, with the nodes that none of the others has; what of their solid
/// has a patch belongs to `heir` (n; rows before) from then on.
void remove_bricks(BrickGrid& grid, const std::vector<bool>& gone, const std::vector<int>& heir);

/// How many pieces the bricks hang together in, by their nodes.
[[nodiscard]] int count_connected(const BrickGrid& grid);

}  // namespace sprung
