#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// A piece of surface whose triangles hang together by their edges, all turned the same way round: the way that most
/// of its triangles were given.
struct Shell {
  std::vector<int> triangles;  // rows of the triangles given, ascending
  double volume = 0;           // signed; negative where the shell was given inside out; of no meaning while it is open
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
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

struct Shells {
  std::vector<Shell> shells;
  EdgeFaults faults;
  std::vector<OpenSide> open;
  std::vector<bool> turned;  // for each triangle, whether it was turned over to agree with its neighbours
};

/// Splits welded triangles into shells and turns them to agree; changes the order of corners of those it turns. Where
/// more than two triangles meet in an edge, those pair that have matter between them, so that bodies that touch there
/// come apart.
[[nodiscard]] Shells find_shells(const Points& points, Triangles& triangles);

/// Sets volume and bounds from the shell's triangles.
void measure(const Points& points, const Triangles& triangles, Shell& shell);

}  // namespace sprung
