#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// A piece of surface whose triangles hang together by their edges, all turned the same way round: the way that most
/// of its triangles were given.
struct Shell {
  std::vector<int> triangles;  // rows of the triangles given
  double volume = 0;           // signed; negative where the shell was given inside out
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
};

struct EdgeFaults {
  int open = 0;          // edges of one triangle
  int loops = 0;         // connected groups of open edges
  int non_manifold = 0;  // edges of more than two triangles
  int one_sided = 0;     // edges where no orientation fits (as on a Moebius strip)
  [[nodiscard]] bool any() const { return open + non_manifold + one_sided > 0; }
};

struct Shells {
  std::vector<Shell> shells;
  EdgeFaults faults;
  int turned = 0;  // triangles turned over to agree with their neighbours
};

/// Splits welded triangles into shells and turns them to agree; changes the order of corners of those it turns.
[[nodiscard]] Shells find_shells(const Points& points, Triangles& triangles);

/// How often the closed surface winds around the point: 1 inside, 0 outside, by the solid angles of its triangles
/// (Van Oosterom and Strackee 1983).
[[nodiscard]] double winding_number(const Points& points, const Triangles& triangles, const std::vector<int>& rows,
                                    const Vec3& at);

}  // namespace sprung
