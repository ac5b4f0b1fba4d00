#pragma once
#include <vector>

#include "core/mesh/repair/components.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// For each row the first row that equals it.
[[nodiscard]] std::vector<int> weld_points(const Points& positions);

/// The triangles of a mesh on distinct points.
struct WeldedMesh {
  Points points;              // p x 3, in the order of their first use
  Triangles triangles;        // t x 3
  std::vector<int> source;    // for each triangle, its row in SurfaceMesh::triangles; -1: part of a cap
  std::vector<bool> flipped;  // for each triangle, whether it is flipped against the mesh
  int joined = 0;             // vertices used by triangles, minus distinct points
  int unreferenced = 0;       // vertices that no triangle of the mesh uses
  int without_area = 0;       // triangles dropped because two of their corners coincide
  int repeated = 0;           // triangles dropped because others have the same three corners
};

/// Merges vertices of exactly equal position and drops triangles that collapse. Slivers with three distinct collinear
/// corners stay: without them their neighbours would have open edges. Of triangles with the same three corners one is
/// kept, but neither of two that face each other, since they enclose nothing (unless most of the mesh is like that: it
/// was then given double-sided).
[[nodiscard]] WeldedMesh weld(const SurfaceMesh& mesh);

/// Merges nearly coincident points on open sides: closer than a quarter of the shortest side at either, and than 1e-3
/// of the mesh's diagonal. The later point moves to the earlier one; triangles that collapse are dropped. Closes cracks
/// due to rounded coordinates. Returns the number of merged points. Deterministic.
int stitch(const std::vector<OpenSide>& open, WeldedMesh& mesh);

}  // namespace sprung
