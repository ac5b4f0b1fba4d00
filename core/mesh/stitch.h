#pragma once
#include <vector>

#include "core/mesh/shells.h"
#include "core/mesh/weld.h"

namespace sprung {

/// Joins points on open sides that almost fall together: nearer to each other than a quarter of the shortest side at
/// either, and than 1e-3 of the diagonal of all. The later point moves to the earlier one; triangles that lose a corner
/// by it are left out. Returns how many points went. Cracks from rounded coordinates close by this. Deterministic.
int stitch(const std::vector<OpenSide>& open, WeldedMesh& mesh);

}  // namespace sprung
