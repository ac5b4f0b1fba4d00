#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// A closed line of open edges, seen from the surface around it.
struct Hole {
  Points rim;     // n x 3, n >= 3; the triangles of the cap run along it in this order
  Points beyond;  // n x 3: the third corner of the surface's triangle at the edge from corner i to i + 1
};

/// Triangles that close a hole. Corner i < n is corner i of the rim; the others are rows of `points`.
struct Cap {
  Points points;  // new ones: empty where the cap is flat
  Triangles triangles;
  bool flat = false;  // the rim lies in a plane up to 3 % of its extent
};

/// Closes a hole by Delaunay triangles in the rim's plane where it has one, else by the triangles that bend least,
/// which then (rims of 8 edges or more) are refined to the density of the rim and faired to continue the surface
/// around it (Liepa 2003). Never fails: a fan closes what CGAL will not. Deterministic.
[[nodiscard]] Cap fill_hole(const Hole& given);

/// How open shells were closed.
struct Closing {
  int flat = 0;                   // caps in a plane
  int smooth = 0;                 // the others
  std::vector<double> cap_areas;  // for each shell
};

/// Closes every loop of open sides by a cap, whose triangles (source -1) and points are appended to
/// `mesh` and to their shells; measures those shells anew. A loop that touches itself is closed in pieces.
/// Deterministic.
Closing close_shells(WeldedMesh& mesh, SurfaceComponents& shells);

}  // namespace sprung
