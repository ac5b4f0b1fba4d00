#pragma once
#include <array>
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// How far the given triangles enclose a volume: the median of the absolute winding number at the centroids of up to
/// 1000 of them. 1/2 for a closed surface, 0.3 for a hemisphere, 0 for a sheet, a band or random triangles. Insensitive
/// to missing triangles and small gaps.
[[nodiscard]] double enclosure(const Points& points, const Triangles& triangles, const std::vector<int>& rows);

/// The least enclosure() of a surface that bounds a volume.
inline constexpr double kEncloses = 0.25;

/// An outer shell and its cavities.
struct NestedComponents {
  const SurfaceComponent* outer;
  std::vector<const SurfaceComponent*> cavities;
  bool is_buried = false;  // inside the solid of another nest, to which it adds nothing
};

/// Nests that form one solid.
using NestGroup = std::vector<NestedComponents>;

/// Groups closed shells into nests, the largest first: a shell of opposite orientation is a cavity of the smallest nest
/// around it, unless it lies in a cavity of that nest.
[[nodiscard]] std::vector<NestedComponents> nest_shells(const Points& points, const Triangles& triangles,
                                                        const std::vector<SurfaceComponent>& shells);

/// Groups nests that intersect (`crossings`: pairs of rows of `triangles`) or lie inside one another, and marks buried
/// ones.
[[nodiscard]] std::vector<NestGroup> unite_nests(const Points& points, const Triangles& triangles,
                                                 std::vector<NestedComponents> nests,
                                                 const std::vector<std::array<int, 2>>& crossings);

/// The solids bounded by closed shells of `mesh`, each with its cavities, in the order of the nests. Shells that
/// overlap, touch or lie inside one another form one solid unless `repair` is kOff. Triangles of `mesh` in no shell are
/// ignored. Lists the repairs inside_out, cavity, united and self_intersection.
[[nodiscard]] Solids assemble_solids(const WeldedMesh& mesh, const std::vector<SurfaceComponent>& shells,
                                     RepairMode repair);

/// The solid bounded by a group of nests: their triangles in the order of the mesh, inside-out nests flipped, and the
/// points they use. Its volume is the sum over nests that are not buried.
[[nodiscard]] Solid cut_solid(const WeldedMesh& mesh, const NestGroup& group);

/// The area of the given triangles, caps excluded.
[[nodiscard]] double given_area(const WeldedMesh& mesh, const std::vector<int>& rows);

}  // namespace sprung
