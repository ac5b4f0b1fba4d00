#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/types.h"

namespace sprung {

/// A side of a triangle; the two ends in ascending order, so that equal edges sort together.
struct Side {
  int low;
  int high;
  int triangle;
  bool forward;  // the triangle runs from low to high
};

/// The sides of all triangles, those on the same edge together, by triangle.
[[nodiscard]] std::vector<Side> sorted_sides(const Triangles& triangles);

/// Calls `visit` with the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    visit(std::span(sides).subspan(begin, end - begin));
  }
}

/// Finds the partners of sides of oriented triangles: two sides that run in opposite directions. Where more than two
/// meet in an edge, those pair that have matter between them, first within each of the pieces given.
class SidePairs {
 public:
  /// `pieces`: for each triangle a number of the piece that it hangs together with by edges of two triangles.
  SidePairs(const Points& points, const Triangles& triangles, const std::vector<int>& pieces);

  /// `edge`: all sides of one edge.
  void pair(std::span<const Side> edge);

  /// Sides without partners, in the order of their edges.
  [[nodiscard]] const std::vector<Side>& open() const { return open_; }
  /// The same for triangles that hang together by partners.
  [[nodiscard]] int shell_of(int triangle) { return sets_.find(triangle); }

 private:
  void pair_many(std::span<const Side> edge);
  void pair_around(std::vector<Side>& sides);
  void sort_around(std::vector<Side>& edge) const;
  [[nodiscard]] int piece_of(const Side& side) const { return pieces_[static_cast<std::size_t>(side.triangle)]; }

  const Points& points_;
  const Triangles& triangles_;
  const std::vector<int>& pieces_;
  DisjointSets sets_;
  std::vector<Side> open_;
};

}  // namespace sprung
