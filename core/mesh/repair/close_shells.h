#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// How open shells were closed.
struct Closing {
  int flat = 0;                   // caps in a plane
  int smooth = 0;                 // the others
  std::vector<double> cap_areas;  // for each shell
};

/// Closes every loop of open sides by a cap (fill_hole.h), whose triangles (source -1) and points are appended to
/// `mesh` and to their shells; measures those shells anew. A loop that touches itself is closed in pieces.
/// Deterministic.
Closing close_shells(WeldedMesh& mesh, SurfaceComponents& shells);

}  // namespace sprung
