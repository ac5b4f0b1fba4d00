#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/solid_samples.h"
#include "core/disjoint_sets.h"
#include "core/mesh/repair/solids.h"

namespace sprung {

/// A connected piece of the solid in one cell.
struct Piece {
  int brick;    // of the grid, whose cells are distinct
  double fill;  // its fraction of the cell
};

/// A sample or spot of a piece; in a full cell, any sample.
struct PieceItem {
  Vec3 position;  // in cells
  int piece;
};

/// All pieces of solid in the cells of a grid, by brick.
class PieceList {
 public:
  PieceList(const CellSurface& surface, const BrickGrid& grid);

  [[nodiscard]] const SolidSamples& samples() const { return samples_; }
  [[nodiscard]] const BrickGrid& grid() const { return grid_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] int count() const { return isize(pieces_); }
  [[nodiscard]] int divided() const { return divided_; }

  /// The pieces of a brick are first(brick) .. first(brick + 1) - 1.
  [[nodiscard]] int first(int brick) const { return first_[brick]; }
  [[nodiscard]] int brick_of(int piece) const { return pieces_[piece].brick; }
  /// The samples of a brick, or null if the surface does not cut it.
  [[nodiscard]] const CutCell* cut(int brick) const;
  /// Returns whether all of its samples are inside.
  [[nodiscard]] bool is_whole(int brick) const;
  /// The piece of a sample or spot of a brick; -1: outside, or too small a piece.
  [[nodiscard]] int at(int brick, int sample) const;
  /// The neighbouring brick, or -1.
  [[nodiscard]] int beside(int brick, const Eigen::Vector3i& offset) const;
  /// From the middle of the cell.
  [[nodiscard]] SolidIntegrals solid_of(int piece) const;
  /// All items of a brick.
  [[nodiscard]] std::vector<PieceItem> items(int brick) const;

 private:
  const BrickGrid& grid_;
  SolidSamples samples_;
  std::vector<Piece> pieces_;
  std::vector<int> first_;
  int divided_ = 0;  // cells of more than one piece
};

/// How the pieces of a solid are connected.
struct PieceLinks {
  DisjointSets corners;         // of 8 piece + corner: those that share a node
  std::vector<int> same_brick;  // by piece: the first piece of its cell that shares its brick
  int attached = 0;             // links too thin for the samples
};

/// Pieces share the corners of a face through which solid continues, and of an edge or a corner that a straight line
/// inside the solid passes. A solid is connected: a piece for which the samples show no link is joined to its nearest
/// neighbour.
[[nodiscard]] PieceLinks link_pieces(const PieceList& list);

/// Counts of what split_pieces() did.
struct PieceReport {
  int divided = 0;            // cells that hold more than one piece
  int attached = 0;           // pieces joined to a neighbour although their link is too thin for the samples
  int dropped = 0;            // bricks of floating specks, removed
  double dropped_volume = 0;  // m^3; compensated by the other bricks' fill
  int floating = 0;           // larger pieces connected to no other
};

/// Gives each of several disconnected pieces of solid in a cell a brick of its own, and connects bricks only where
/// solid continues through their common face. Connectivity is found from 8 x 8 x 8 samples per cut cell, the lines
/// between them and, where these are inconclusive, straight lines that meet no triangle: gaps separate however narrow
/// they are, solid connects down to about a twentieth of a brick. A piece of fewer than 4 samples is added to the fill
/// of a larger one next to it. The volume is preserved. After Nesme, Kry, Jerabkova and Faure, "Preserving topology and
/// elasticity for embedded deformable models" (2009). `grid`: voxelize()'s for the same solid; that of a shell or of
/// unconnected triangles stays unchanged. Deterministic.
PieceReport split_pieces(const Solid& solid, BrickGrid& grid);

}  // namespace sprung
