#pragma once
#include <vector>

#include "core/mesh/shells.h"
#include "core/mesh/solids.h"
#include "core/mesh/weld.h"

namespace sprung {

/// The solids that closed shells bound: each with its cavities, and as one what overlaps, touches or lies in another,
/// unless `repair` is kOff. `shells` are of triangles of `mesh`, whose other triangles count nothing. Order: by the
/// nests' (nest.h). Of the repairs those kinds that this finds: inside_out, cavity, united, self_intersection.
[[nodiscard]] Solids assemble_solids(const WeldedMesh& mesh, const std::vector<Shell>& shells, RepairMode repair);

}  // namespace sprung
