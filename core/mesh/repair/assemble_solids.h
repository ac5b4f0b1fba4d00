#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/nesting.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// The solids that closed shells bound: each with its cavities, and as one what overlaps, touches or lies in another,
/// unless `repair` is kOff. `shells` are of triangles of `mesh`, whose other triangles count nothing. Order: by the
/// nests' (nest.h). Of the repairs those kinds that this finds: inside_out, cavity, united, self_intersection.
[[nodiscard]] Solids assemble_solids(const WeldedMesh& mesh, const std::vector<SurfaceComponent>& shells,
                                     RepairMode repair);

/// The solid that a group of nests bounds: their triangles in the order of the mesh, inside-out nests turned, and the
/// points they use. The volume is the sum of the nests that are not buried in others.
[[nodiscard]] Solid cut_solid(const WeldedMesh& mesh, const NestGroup& group);

/// The area of those of the triangles that the mesh has itself, without caps.
[[nodiscard]] double given_area(const WeldedMesh& mesh, const std::vector<int>& rows);

}  // namespace sprung
