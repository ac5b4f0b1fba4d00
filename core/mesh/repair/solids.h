#pragma once
#include <string>
#include <vector>

#include "core/mesh/repair/repair.h"
#include "core/mesh/solid.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

struct Solids {
  std::vector<Solid> solids;     // largest volume first
  std::vector<Repair> repairs;   // what had to be changed, with counts
  Vec3 crossing = Vec3::Zero();  // where the surface crosses itself first, if it does
};

struct SolidOptions {
  RepairMode repair = RepairMode::kAuto;
  double thickness = 0;  // > 0: every piece of the surface becomes a shell of this thickness, in units of the mesh
};

/// Splits a mesh into its solids, and mends it where it must; every kind of repair is listed. A sound mesh is left
/// alone, and its triangles keep their order.
///
/// Points are welded by exact position, so a seam in the index lists is no hole. Triangles without area and repeated
/// ones are dropped; orientation is made consistent, then outward. Where more than two triangles meet in an edge, the
/// bodies that touch there come apart. Rims that almost coincide are stitched (stitch.h), holes are capped: flat where
/// the rim is, else smoothly (fill_hole.h); what is drawn gets the caps too (submesh.h). A closed piece inside another,
/// turned the other way, is its cavity; pieces turned the same way that overlap, touch or lie in one another are one
/// solid. Pieces without volume and floating specks are dropped. Where most of the surface is loose pieces that enclose
/// something only together, that is one solid whose inside winding numbers decide.
///
/// Throws Error(kBadInput), naming `name` and the reason, where nothing encloses a volume (flat, an open sheet,
/// one-sided, triangles without an inside), or where `repair` does not allow what would be needed. No tolerance is
/// absolute. Deterministic.
[[nodiscard]] Solids find_solids(const SurfaceMesh& mesh, const std::string& name, const SolidOptions& options = {});

}  // namespace sprung
