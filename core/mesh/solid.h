#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// What bounds one connected piece of matter, on exactly-welded points: closed, outward-oriented surfaces, its cavities
/// included (cavity shells face inwards, that is, into the hole). Surfaces that overlap or lie in one another bound the
/// union of what each encloses. Bricks are to be filled where the surface winds around a point at all.
struct Solid {
  Points points;              // p x 3, same units and frame as the mesh
  Triangles triangles;        // t x 3, indices into points, outward
  std::vector<int> source;    // for each triangle, its row in SurfaceMesh::triangles; -1: a cap that closes a hole
  std::vector<bool> flipped;  // for each triangle, whether the mesh has it the other way round
  double volume = 0;          // > 0, cubed units of the mesh
  bool overlaps = false;      // it crosses itself: `volume` counts what is enclosed twice twice (bricks/voxelize.h)
  bool closed = true;         // false: loose triangles; inside is where the winding number is beyond 1/2
  double thickness = 0;       // > 0: the matter is what lies within half of this from the triangles, which may be open
};

/// A solid smaller than this share of the largest one, or a piece of solid of this share that touches nothing else, is
/// a floating speck.
inline constexpr double kSpeckShare = 1e-4;

}  // namespace sprung
