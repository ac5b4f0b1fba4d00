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
class EdgePairs {
 public:
  /// `pieces`: for each triangle a number of the piece that it hangs together with by edges of two triangles.
  EdgePairs(const Points& points, const Triangles& triangles, const std::vector<int>& pieces);

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
  [[nodiscard]] int piece_of(const Side& side) const { return pieces_[side.triangle]; }

  const Points& points_;
  const Triangles& triangles_;
  const std::vector<int>& pieces_;
  DisjointSets sets_;
  std::vector<Side> open_;
};

/// A piece of surface whose triangles hang together by their edges, all turned the same way round: the way that most
/// of its triangles were given.
struct SurfaceComponent {
  std::vector<int> triangles;  // rows of the triangles given, ascending
  double volume = 0;           // signed; negative where the shell was given inside out; of no meaning while it is open
  AlignedBox bounds;
};

struct EdgeFaults {
  int open = 0;          // edges of one triangle
  int loops = 0;         // connected groups of open edges
  int non_manifold = 0;  // edges of more than two triangles
  int one_sided = 0;     // edges where no orientation fits (as on a Moebius strip)
};

/// The side of a triangle that has no partner: where the surface is open, one-sided, or more than two triangles meet
/// that do not pair. The sides of one shell make closed loops.
struct OpenSide {
  int from;
  int to;
  int triangle;
  int shell;
};

struct SurfaceComponents {
  std::vector<SurfaceComponent> shells;
  EdgeFaults faults;
  std::vector<OpenSide> open;
  std::vector<bool> flipped;  // for each triangle, whether it was turned over to agree with its neighbours
};

/// Splits welded triangles into shells and turns them to agree; changes the order of corners of those it turns. Where
/// more than two triangles meet in an edge, those pair that have matter between them, so that bodies that touch there
/// come apart.
[[nodiscard]] SurfaceComponents find_shells(const Points& points, Triangles& triangles);

[[nodiscard]] double triangle_area(const Points& points, const Triangles& triangles, int row);

/// Sets volume and bounds from the shell's triangles.
void measure(const Points& points, const Triangles& triangles, SurfaceComponent& shell);

}  // namespace sprung
