#pragma once
#include <array>
#include <utility>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// The triangles of one cell of a drawn skin: points of a body's skin_embedding, by the skin's vertices.
using CellTriangles = std::vector<std::array<int, 3>>;

/// Bounds on the cells of a skin from the bricks that carry them, without placing any vertex: boxes that enclose the
/// cells, and where neighbouring ones may cross each other.
///
/// Cells are neighbours where their bricks share a node. As long as all bricks of two neighbours are deformed by less
/// than kTame of their size, rotation apart, and turned against each other by no more, the carried surfaces keep their
/// order, with two exceptions that are detected at rest: surfaces that face each other within kFacing bricks, and those
/// that lie back to back closer than kThin.
class CellBricks {
 public:
  static constexpr double kTame = 0.3;
  static constexpr double kFacing = 1;
  static constexpr double kThin = 0.05;

  CellBricks(const SoftBody& body, const std::vector<CellTriangles>& cells);

  /// Moves the nodes (m x 3, m) here.
  void follow(const Points& nodes);

  /// By cell, m.
  [[nodiscard]] const std::vector<AlignedBox>& boxes() const { return boxes_; }
  [[nodiscard]] bool are_neighbours(int a, int b) const;
  /// Neighbours, and cells with themselves, that must be checked; the lower row first.
  [[nodiscard]] const std::vector<std::array<int, 2>>& suspects() const { return suspects_; }

 private:
  struct Carrier {
    int brick;
    AlignedBox part;  // of it, that encloses what it carries of the cell: coordinates in the brick
  };
  struct Neighbours {
    std::array<int, 2> cells;
    bool is_delicate;  // facing or thin at rest
  };

  void find_neighbours(const std::vector<CellTriangles>& cells);
  void measure_bricks(const Points& nodes);

  const SoftBody& body_;
  std::vector<std::vector<Carrier>> carriers_;  // by cell
  std::vector<Neighbours> pairs_;
  std::vector<std::vector<int>> neighbours_;  // by cell, ascending
  std::vector<char> is_used_;                 // by brick: carries any cell
  std::vector<Mat3> rotations_;               // by brick
  std::vector<double> strains_;    // by brick: the largest of its edges, over their length, without the rotation
  std::vector<double> of_cells_;   // the largest strain in each, with the turns of its bricks
  std::vector<AlignedBox> boxes_;  // by cell
  std::vector<std::array<int, 2>> suspects_;
};

}  // namespace sprung
