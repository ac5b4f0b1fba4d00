#pragma once
#include <string>
#include <vector>

#include "core/mesh/repair.h"
#include "core/mesh/surface_mesh.h"

namespace sprung {

/// What bounds one connected piece of matter, on exactly-welded points: closed, outward-oriented surfaces, its cavities
/// included (cavity shells face inwards, that is, into the hole). Surfaces that overlap or lie in one another bound the
/// union of what each encloses. Bricks are to be filled where the surface winds around a point at all.
struct Solid {
  Points points;             // p x 3, same units and frame as the mesh
  Triangles triangles;       // t x 3, indices into points, outward
  std::vector<int> source;   // for each triangle, its row in SurfaceMesh::triangles; -1: a cap that closes a hole
  std::vector<bool> turned;  // for each triangle, whether the mesh has it the other way round
  double volume = 0;         // > 0, cubed units of the mesh
  bool overlaps = false;     // it crosses itself: `volume` counts what is enclosed twice twice (bricks/voxelize.h)
  bool closed = true;        // false: loose triangles; inside is where the winding number is beyond 1/2
  double thickness = 0;      // > 0: the matter is what lies within half of this from the triangles, which may be open
};

/// A solid smaller than this share of the largest one, or a piece of solid of this share that touches nothing else, is
/// a floating speck.
inline constexpr double kSpeckShare = 1e-4;

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
