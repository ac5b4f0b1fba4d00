#pragma once
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Vertices split so that each has one normal.
struct SplitVertices {
  std::vector<int> source;  // k; the mesh vertex that each split vertex copies
  Points normals;           // k x 3, unit
  Triangles triangles;      // t x 3, indices of split vertices
};

/// Normals for drawing. The mesh's own are kept where it has them (turned where they point inwards); else corners at
/// one point share the angle-weighted mean normal of their triangles as long as these meet at less than
/// `crease_angle` degrees, so that sharp edges stay sharp.
[[nodiscard]] SplitVertices split_at_creases(const SurfaceMesh& mesh, double crease_angle);

/// Row numbers that call equal positions equal: point_of[i] == point_of[j] where rows i and j are the same point.
[[nodiscard]] std::vector<int> weld_points(const Points& positions);

}  // namespace sprung
