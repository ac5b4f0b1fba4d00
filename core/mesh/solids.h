#pragma once
#include <string>
#include <vector>

#include "core/mesh/repair.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// One closed, outward-oriented surface made of exactly-welded points: the boundary of one connected piece of matter,
/// its cavities included (cavity shells face inwards, that is, into the hole).
struct Solid {
  Points points;            // p x 3, same units and frame as the mesh
  Triangles triangles;      // t x 3, indices into points, outward
  std::vector<int> source;  // for each triangle, its row in SurfaceMesh::triangles
  double volume = 0;        // > 0, cubed units of the mesh
};

struct Solids {
  std::vector<Solid> solids;    // largest volume first
  std::vector<Repair> repairs;  // what had to be changed, with counts
};

/// Splits a mesh into its closed solids. Points are welded by exact position, so a seam in the index lists is no hole.
/// Triangles without area and repeated ones are dropped, inconsistent or inside-out orientation is mended, each with a
/// note; so are closed pieces without volume. A closed piece inside another, turned the other way, is its cavity;
/// pieces turned the same way stay solids of their own. Self-intersection is allowed: `volume` then counts an overlap
/// twice. Throws Error(kBadInput), naming `name` and the counts, where a piece is open or not manifold or where none
/// has volume. Deterministic.
[[nodiscard]] Solids find_solids(const SurfaceMesh& mesh, const std::string& name);

}  // namespace sprung
