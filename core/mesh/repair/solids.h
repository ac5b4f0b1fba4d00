#pragma once
#include <string>
#include <vector>

#include "core/mesh/repair/repair.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

struct Solids {
  std::vector<Solid> solids;     // largest volume first
  std::vector<Repair> repairs;   // what was changed, with counts
  Vec3 crossing = Vec3::Zero();  // the first point where the surface intersects itself, if any
};

struct SolidOptions {
  RepairMode repair = RepairMode::kAuto;
  double thickness = 0;  // > 0: every piece of the surface becomes a shell of this thickness, in units of the mesh
};

/// Splits a mesh into its solids and repairs it where necessary; every kind of repair is listed. A sound mesh stays
/// unchanged, and its triangles keep their order.
///
/// Points are welded by exact position, so a seam in the index lists is no hole. Triangles without area and duplicates
/// are dropped; orientation is made consistent, then outward. Bodies that touch at edges of more than two triangles are
/// separated. Nearly coincident rims are stitched (weld.h) and holes capped, flat where the rim is planar, else
/// smoothly (close_shells.h); the drawn mesh gets the caps, too (submesh.h). A closed shell inside another of opposite
/// orientation is its cavity; shells of equal orientation that overlap, touch or nest form one solid. Pieces without
/// volume and floating specks are dropped. Where most of the surface is disconnected pieces that enclose a volume only
/// together, they form one solid, whose inside is decided by winding numbers.
///
/// Throws Error(kBadInput), naming `name` and the reason, if nothing encloses a volume (flat, an open sheet, one-sided,
/// triangles without an inside), or if `repair` forbids a necessary repair. All tolerances are relative. Deterministic.
[[nodiscard]] Solids find_solids(const SurfaceMesh& mesh, const std::string& name, const SolidOptions& options = {});

}  // namespace sprung
