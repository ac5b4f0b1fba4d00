#pragma once
#include <vector>

#include "core/bricks/solid_samples.h"

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
  [[nodiscard]] int count() const { return static_cast<int>(pieces_.size()); }
  [[nodiscard]] int divided() const { return divided_; }

  /// Those of a brick are first(brick) .. first(brick + 1) - 1.
  [[nodiscard]] int first(int brick) const { return first_[static_cast<std::size_t>(brick)]; }
  [[nodiscard]] int brick_of(int piece) const { return pieces_[static_cast<std::size_t>(piece)].brick; }
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

}  // namespace sprung
