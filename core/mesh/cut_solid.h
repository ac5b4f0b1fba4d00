#pragma once
#include <vector>

#include "core/mesh/nest.h"
#include "core/mesh/solids.h"
#include "core/mesh/weld.h"

namespace sprung {

/// The solid that a group of nests bounds: their triangles in the order of the mesh, inside-out nests turned, and the
/// points they use. The volume is the sum of the nests that are not buried in others.
[[nodiscard]] Solid cut_solid(const WeldedMesh& mesh, const NestGroup& group);

/// The area of those of the triangles that the mesh has itself, without caps.
[[nodiscard]] double given_area(const WeldedMesh& mesh, const std::vector<int>& rows);

}  // namespace sprung
