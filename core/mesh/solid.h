#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// The boundary of one connected solid, on exactly welded points: closed, outward-oriented surfaces, including those of
/// its cavities, which face into the cavity. Overlapping or nested surfaces bound the union of their interiors: a point
/// is inside where its winding number is not 0.
struct Solid {
  Points points;              // p x 3, same units and frame as the mesh
  Triangles triangles;        // t x 3, indices into points, outward
  std::vector<int> source;    // for each triangle, its row in SurfaceMesh::triangles; -1: a cap that closes a hole
  std::vector<bool> flipped;  // for each triangle, whether its orientation is opposite to the mesh's
  double volume = 0;          // > 0, cubed units of the mesh
  bool overlaps = false;      // it intersects itself, and `volume` counts overlaps twice (see enclosed_volume)
  bool closed = true;         // false: unconnected triangles; inside is where |winding number| > 1/2
  double thickness = 0;       // > 0: a shell, all points within half of this of the triangles, which may be open
};

/// Solids below this fraction of the largest one's volume are floating specks, and so are disconnected pieces below
/// this fraction of their solid.
inline constexpr double kSpeckShare = 1e-4;

}  // namespace sprung
