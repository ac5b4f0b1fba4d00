#pragma once
#include <array>
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/repair/weld.h"

namespace sprung {

/// How much the triangles whose rows are given enclose: the median, over at most 1000 of them, of the winding number in
/// their middles, without sign. 1/2 for a closed surface, 0.3 for half a sphere, 0 for a sheet, a band, or triangles at
/// random. Changes little where triangles are missing or do not quite meet.
[[nodiscard]] double enclosure(const Points& points, const Triangles& triangles, const std::vector<int>& rows);

/// From this on a surface counts as the boundary of something.
inline constexpr double kEncloses = 0.25;

/// A shell that bounds matter from outside, with the cavities in it.
struct NestedComponents {
  const SurfaceComponent* outer;
  std::vector<const SurfaceComponent*> cavities;
  bool is_buried = false;  // it lies in the matter of another nest and adds nothing to it
};

/// The nests that are one solid.
using NestGroup = std::vector<NestedComponents>;

/// Closed shells in their nests, from the largest to the smallest: a shell is a cavity of the smallest nest around it
/// when it is turned the other way and in none of that nest's cavities.
[[nodiscard]] std::vector<NestedComponents> nest_shells(const Points& points, const Triangles& triangles,
                                                        const std::vector<SurfaceComponent>& shells);

/// Groups the nests that cross (pairs of rows of `triangles`) or of which one lies in the matter of the other, and
/// marks those that do.
[[nodiscard]] std::vector<NestGroup> unite_nests(const Points& points, const Triangles& triangles,
                                                 std::vector<NestedComponents> nests,
                                                 const std::vector<std::array<int, 2>>& crossings);

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
