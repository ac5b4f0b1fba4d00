#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/solid_samples.h"
#include "core/disjoint_sets.h"
#include "core/mesh/repair/solids.h"

namespace sprung {

/// One piece of the solid in one cell.
struct Piece {
  int brick;    // of the grid, in which every cell comes once
  double fill;  // its share of the cell
};

/// A sample or spot of a piece; in a cell that is whole any place of a sample.
struct PieceItem {
  Vec3 place;  // in cells
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

  /// Those of a brick are first(brick) .. first(brick + 1) - 1.
  [[nodiscard]] int first(int brick) const { return first_[brick]; }
  [[nodiscard]] int brick_of(int piece) const { return pieces_[piece].brick; }
  /// The samples of a brick, or null where the surface does not cut it.
  [[nodiscard]] const CutCell* cut(int brick) const;
  /// Whether all of its samples are inside.
  [[nodiscard]] bool is_whole(int brick) const;
  /// The piece that a sample or spot of a brick is in; -1: outside, or too little.
  [[nodiscard]] int at(int brick, int sample) const;
  /// The brick beside one, or -1.
  [[nodiscard]] int beside(int brick, const Eigen::Vector3i& offset) const;
  /// All items of a brick.
  [[nodiscard]] std::vector<PieceItem> items(int brick) const;

 private:
  const BrickGrid& grid_;
  SolidSamples samples_;
  std::vector<Piece> pieces_;
  std::vector<int> first_;
  int divided_ = 0;  // cells of more than one piece
};

/// How the pieces of a solid hang together.
struct PieceLinks {
  DisjointSets corners;         // of 8 piece + corner: those that are one node
  std::vector<int> same_brick;  // by piece: the first piece of its cell that it makes one brick with
  int attached = 0;             // links too thin to be seen
};

/// Pieces share the corners of a face that solid runs through, and those of an edge or a corner that a straight line
/// inside runs past. A solid is one piece: what the samples leave without a link is joined to its nearest neighbour.
[[nodiscard]] PieceLinks link_pieces(const PieceList& list);

/// What split_pieces() found.
struct PieceReport {
  int divided = 0;   // cells that hold more than one piece
  int attached = 0;  // pieces whose link to the rest is too thin to be seen, joined to a neighbour all the same
  int dropped = 0;   // bricks of floating specks, gone
  double dropped_volume = 0;  // m^3; the other bricks' fill makes up for it
  int floating = 0;           // larger pieces that hang together with no other
};

/// Gives the pieces of solid that share a cell but do not hang together in it a brick each, and joins bricks only where
/// solid runs from one to the next through their face. What hangs together is found from 8 x 8 x 8 samples a cell that
/// the surface cuts, the lines between them and, where those say nothing, straight lines that meet no triangle: a gap
/// counts however narrow, solid down to about a twentieth of a brick. A piece of less than 4 samples beside a larger
/// one is given to that one's fill. The volume stays. After Nesme, Kry, Jerabkova and Faure, "Preserving topology and
/// elasticity for embedded deformable models" (2009). `grid` is voxelize()'s for the same solid;
/// that of a shell or of loose triangles stays as it is. Deterministic.
PieceReport split_pieces(const Solid& solid, BrickGrid& grid);

/// Gives the solid of nearly empty bricks (fill below `least_fill`) to the fullest brick that shares a face with them,
/// if that is at least half full, and removes them: under a touch such a brick is a layer far softer than the sliver of
/// solid it stands for, and it would be crushed. The volume stays; a receiving brick's fill may pass 1. A sliver that
/// its neighbours need to hang on to the body stays too, so thin parts are neither lost nor cut off.
/// Returns how many bricks are gone.
int absorb_slivers(BrickGrid& grid, double least_fill = 0.1);

}  // namespace sprung
