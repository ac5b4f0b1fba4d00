#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/bricks/solid_moments.h"
#include "core/disjoint_sets.h"
#include "core/types.h"

namespace sprung {

/// The solid of one brick within one cell that the surface cuts. The brick is usually at that cell; an absorbed sliver
/// (absorb_slivers) belongs to a neighbouring brick.
struct SolidPatch {
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();
  int brick = 0;
  std::bitset<512> samples;            // bit x + 8 y + 64 z: the point at (x, y, z) + 1/2 eighths of the cell
  std::vector<Eigen::Vector3f> spots;  // points of solid too thin for samples, in [0, 1]^3 of the cell
  SolidIntegrals solid;                // relative to the middle of the cell
};

/// The bricks of one body: the cells of a cubic lattice that hold solid, and the nodes at their corners. Corner c of a
/// brick lies at cell + (c & 1, c >> 1 & 1, c >> 2 & 1): x runs fastest. A cell that contains several disconnected
/// pieces of solid (two fingers) has a brick for each piece: the cell then occurs several times, in consecutive rows.
/// Bricks share nodes only where solid continues from one to the next through a face (see pieces.h), so a lattice point
/// may occur several times as well, in consecutive rows, with a node each.
struct BrickGrid {
  Vec3 origin = Vec3::Zero();             // corner of cell (0, 0, 0), m, in the body's rest frame
  double brick_size = 0;                  // side h, m
  std::vector<Eigen::Vector3i> cells;     // n; ordered by z, then y, then x
  std::vector<double> fill;               // n; solid volume over brick volume; in (0, 1], above with absorbed slivers
  std::vector<std::array<int, 8>> nodes;  // n; rows of lattice, by corner
  std::vector<Eigen::Vector3i> lattice;   // m; lattice coordinates of each node, ordered by z, then y, then x
  std::vector<SolidPatch> patches;        // of the cells that the surface cuts, ordered as cells; empty: not computed
  std::vector<SolidMoments> moments;      // n; empty: unknown, all as for a full brick

  [[nodiscard]] int brick_count() const { return isize(cells); }
  [[nodiscard]] int node_count() const { return isize(lattice); }
  [[nodiscard]] double brick_volume() const { return brick_size * brick_size * brick_size; }
  /// Volume of the solid in the bricks: sum of fill h^3, m^3.
  [[nodiscard]] double volume() const;
  /// m x 3, metres.
  [[nodiscard]] Points rest_positions() const;
};

/// Every cell of a box of counts x, y, z, completely filled, its low corner at the origin.
[[nodiscard]] BrickGrid make_box_grid(const Eigen::Vector3i& counts, double brick_size);

/// Numbers the nodes of a grid whose cells are set, ordered and distinct: neighbours share coincident corners. Cost:
/// linear in the cells.
void number_nodes(BrickGrid& grid);

/// The same for cells that may repeat: `corners` joins the brick corners (8 brick + corner) that share a node; these
/// must be at the same lattice point.
void number_nodes(BrickGrid& grid, DisjointSets& corners);

/// Removes the bricks for which `gone` (n) is set, with the nodes that only they use; their patches pass to the bricks
/// `heir` (n; rows before the removal).
void remove_bricks(BrickGrid& grid, const std::vector<bool>& gone, const std::vector<int>& heir);

/// The number of connected components of the bricks, by shared nodes.
[[nodiscard]] int count_connected(const BrickGrid& grid);

/// m, in the frame of the grid.
[[nodiscard]] inline Vec3 brick_middle(const BrickGrid& grid, int brick) {
  return grid.origin + grid.brick_size * (grid.cells[brick].cast<double>().array() + 0.5).matrix();
}

/// Finds the bricks at a cell of the lattice.
class CellIndex {
 public:
  explicit CellIndex(const BrickGrid& grid) : CellIndex(grid.cells) {}
  /// The same for any rows of cells.
  explicit CellIndex(const std::vector<Eigen::Vector3i>& cells) {
    row_of_cell_.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) row_of_cell_.emplace(key(cells[i]), i);
  }

  /// The first brick of a cell with several, which are consecutive; -1: none.
  [[nodiscard]] int at(const Eigen::Vector3i& cell) const {
    const auto found = row_of_cell_.find(key(cell));
    return found == row_of_cell_.end() ? -1 : found->second;
  }

 private:
  /// 21 bits an axis, for cells from -2^20 to 2^20.
  static std::uint64_t key(const Eigen::Vector3i& cell) {
    const auto part = [&](int axis) { return static_cast<std::uint64_t>(cell[axis] + (1 << 20)) & 0x1fffffU; };
    return part(0) | part(1) << 21 | part(2) << 42;
  }

  std::unordered_map<std::uint64_t, int> row_of_cell_;
};

/// The neighbours of a brick by side (2 axis, + 1 on the high side); -1: none. If there are several, the first.
/// `index`: of this grid.
[[nodiscard]] std::array<int, 6> face_neighbours(const BrickGrid& grid, const CellIndex& index, std::size_t brick);

/// The brick corners (8 brick + corner) at each node, in the order of the bricks: those of node i are corners[first[i]]
/// .. corners[first[i + 1] - 1].
struct CornerLists {
  std::vector<int> first;
  std::vector<int> corners;
};

/// `bricks`: their nodes by corner.
[[nodiscard]] CornerLists list_corners(const std::vector<std::array<int, 8>>& bricks, int node_count);

/// One of the six sides of a brick.
struct BrickFace {
  std::array<int, 4> nodes;  // counter-clockwise from outside
  int side;                  // 2 axis + (1 on the high side)
  int brick;
};

/// All sides of the bricks that are `shown` (one entry per brick), brick by brick.
[[nodiscard]] std::vector<BrickFace> brick_faces(const BrickGrid& grid, const std::vector<bool>& shown);

/// Those not shared by two shown bricks.
[[nodiscard]] std::vector<BrickFace> outer_faces(const BrickGrid& grid, const std::vector<bool>& shown);
[[nodiscard]] std::vector<BrickFace> outer_faces(const BrickGrid& grid);

}  // namespace sprung
