#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// A closed loop of boundary edges.
struct Hole {
  Points rim;     // n x 3, n >= 3; in the orientation of the cap's triangles
  Points beyond;  // n x 3: the third corner of the surface's triangle at the edge from corner i to i + 1
};

/// The triangles that fill a hole. Vertex i < n is that of the rim; vertex n + i is row i of `points`.
struct Cap {
  Points points;  // interior vertices; none in flat caps
  Triangles triangles;
  bool flat = false;  // the rim is planar to within 3 % of its extent
};

/// Fills a planar hole by a Delaunay triangulation, any other by the triangulation of least bending, which (from 8
/// edges on) is refined to the density of the rim and faired to continue the surrounding surface (Liepa 2003). Never
/// fails: if CGAL finds no triangulation, a fan is used. Deterministic.
[[nodiscard]] Cap fill_hole(const Hole& given);

/// The repairs that close_shells() made.
struct Closing {
  int flat = 0;            // planar caps
  int smooth = 0;          // the others
  double largest_cap = 0;  // its area
};

/// Fills every loop of open sides with a cap, appends its triangles (source -1) and points to `mesh` and to its shell,
/// and remeasures that shell. A loop that touches itself is filled in parts. Deterministic.
Closing close_shells(WeldedMesh& mesh, SurfaceComponents& shells);

}  // namespace sprung
