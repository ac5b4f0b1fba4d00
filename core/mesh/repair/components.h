#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/types.h"

namespace sprung {

/// A side of a triangle; its ends in ascending order, so that the sides of one edge sort together.
struct Side {
  int low;
  int high;
  int triangle;
  bool forward;  // the triangle runs from low to high
};

/// The sides of all triangles, sorted by edge, then by triangle.
[[nodiscard]] std::vector<Side> sorted_sides(const Triangles& triangles);

/// Calls `visit` with the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    visit(std::span(sides).subspan(begin, end - begin));
  }
}

/// Pairs the sides of oriented triangles that run in opposite directions. At edges of more than two triangles, those
/// with solid between them are paired, first within each of the given pieces.
class EdgePairs {
 public:
  /// `pieces`: for each triangle, the number of its component connected by edges of two triangles.
  EdgePairs(const Points& points, const Triangles& triangles, const std::vector<int>& pieces);

  /// `edge`: all sides of one edge.
  void pair(std::span<const Side> edge);

  /// Unpaired sides, in the order of their edges.
  [[nodiscard]] const std::vector<Side>& open() const { return open_; }
  /// Equal for triangles connected by paired sides.
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

/// A component of the surface, connected by edges and consistently oriented: the way most of its triangles were given.
struct SurfaceComponent {
  std::vector<int> triangles;  // rows of the triangles given, ascending
  double volume = 0;           // signed; negative for an inside-out shell; meaningless while it is open
  AlignedBox bounds;
};

struct EdgeFaults {
  int open = 0;          // edges of one triangle
  int loops = 0;         // connected groups of open edges
  int non_manifold = 0;  // edges of more than two triangles
  int one_sided = 0;     // edges without a consistent orientation (as on a Moebius strip)
};

/// An unpaired side: at a boundary, on a one-sided surface, or at an edge of more than two triangles that do not pair.
/// The open sides of one shell form closed loops.
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
  std::vector<bool> flipped;  // for each triangle, whether it was flipped to agree with its neighbours
};

/// Splits welded triangles into consistently oriented shells, flipping triangles in place. At edges of more than two
/// triangles, those with solid between them are paired, so that bodies touching there come apart.
[[nodiscard]] SurfaceComponents find_shells(const Points& points, Triangles& triangles);

[[nodiscard]] double triangle_area(const Points& points, const Triangles& triangles, int row);

/// Sets volume and bounds from the shell's triangles.
void measure(const Points& points, const Triangles& triangles, SurfaceComponent& shell);

}  // namespace sprung
