#pragma once
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "core/contact/watch/cell_bricks.h"
#include "core/mesh/query/winding_tree.h"
#include "core/skin/skin.h"
#include "core/types.h"
#include "core/world/world.h"

namespace sprung {

/// A drawn skin as one surface: vertices of equal position at rest are one vertex. Its triangles are grouped into
/// cells, those of a body by the bricks that carry them, with a tree of boxes over the cells. It follows the nodes of a
/// body; vertices are placed only in requested cells. Shares nothing with contact search.
class DrawnSurface {
 public:
  /// A node of the tree. Parents precede their children.
  struct Node {
    AlignedBox box;
    int cell;          // of a leaf; -1: has two children, the next node and
    int second_child;  // this one
  };
  /// Rows of triangles: first ... last - 1.
  struct Cell {
    int first;
    int last;
  };

  /// The surface of a body at rest. Triangles whose corners are not three different vertices are left out. It must
  /// outlive this.
  explicit DrawnSurface(const SoftBody& body);
  /// The surface of a rigid skin at its current position, completely placed.
  explicit DrawnSurface(const Skin& skin);

  /// Moves the nodes (m x 3, m) of the body here until the next call. No vertex is placed.
  void follow(const Points& nodes);
  /// Moves the vertices of the rigid skin (all of them, m) here.
  void move_to(const Points& vertices);

  /// Places the vertices of these cells.
  void place_vertices(const std::vector<int>& cells);
  /// Places all vertices and makes winding() ready.
  void complete();

  [[nodiscard]] const Points& points() const { return points_; }           // p x 3, m
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }  // of points, by cell
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const AlignedBox& box_of(int cell) const { return nodes_[leaves_[cell]].box; }
  [[nodiscard]] AlignedBox box() const { return nodes_.empty() ? AlignedBox() : nodes_.front().box; }
  /// The vertices that share an edge with each, ascending.
  [[nodiscard]] const std::vector<std::vector<int>>& neighbours() const { return neighbours_; }
  /// The bricks of its cells; null for rigid skins.
  [[nodiscard]] const CellBricks* bricks() const { return bricks_.get(); }
  /// It must not have moved since complete().
  [[nodiscard]] const WindingTree& winding() const { return *winding_; }

 private:
  /// `owners`: by the skin's vertex; the triangles of one owner make cells of their own.
  void build(const Skin& skin, const std::vector<int>& owners);
  void add_cells(std::vector<int>& rows, int first, int last, const Points& middles);
  void add_node(std::vector<int>& cells, int first, int last, const Points& middles);
  void refit(const std::vector<AlignedBox>& boxes);

  const SoftBody* body_ = nullptr;
  const Points* body_nodes_ = nullptr;
  std::vector<int> sources_;  // by point: the skin's vertex that gives its position
  Points points_;
  std::vector<char> is_placed_;  // by point
  Triangles triangles_;
  std::vector<Cell> cells_;
  std::vector<Node> nodes_;
  std::vector<int> leaves_;  // by cell: row in nodes_
  std::vector<std::vector<int>> neighbours_;
  std::unique_ptr<CellBricks> bricks_;
  std::unique_ptr<WindingTree> winding_;
};

}  // namespace sprung
