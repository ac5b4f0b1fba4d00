#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The triangles of a mesh on points that are each there once.
struct WeldedMesh {
  Points points;              // p x 3, in the order of their first use
  Triangles triangles;        // t x 3
  std::vector<int> source;    // for each triangle, its row in SurfaceMesh::triangles; -1: it closes a hole
  std::vector<bool> flipped;  // for each triangle, whether it runs around the other way than in the mesh
  int joined = 0;             // vertices of triangles less the points that they became
  int unreferenced = 0;       // vertices that no triangle of the mesh uses
  int without_area = 0;       // triangles left out because two of their corners fall together
  int repeated = 0;           // triangles left out because others have the same three corners
};

/// Joins vertices of exactly equal position and leaves out what then is no triangle. A sliver with three different
/// corners in a line stays: without it its neighbours would have open edges. Of triangles with the same three corners
/// one stays, but none of two that face each other, since there is nothing between them (unless most of the mesh is so:
/// then it was given with a front and a back).
[[nodiscard]] WeldedMesh weld(const SurfaceMesh& mesh);

/// Joins points on open sides that almost fall together: nearer to each other than a quarter of the shortest side at
/// either, and than 1e-3 of the diagonal of all. The later point moves to the earlier one; triangles that lose a corner
/// by it are left out. Returns how many points went. Cracks from rounded coordinates close by this. Deterministic.
int stitch(const std::vector<OpenSide>& open, WeldedMesh& mesh);

}  // namespace sprung
