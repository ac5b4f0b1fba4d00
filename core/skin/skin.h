#pragma once
#include <vector>

#include "core/mesh/surface_mesh.h"
#include "core/types.h"

namespace sprung {

using Floats3 = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Floats2 = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Floats4 = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The triangles that are drawn and that touch other things, at rest. Finer than the mesh: creases are split so that
/// every vertex has one normal, and long edges are halved until they can follow the bend of a brick.
struct Skin {
  Points positions;         // n x 3, m, body's rest frame
  Points normals;           // n x 3, unit, outward
  Floats2 uvs;              // n x 2; 0 rows: none
  Floats4 colors;           // n x 4, sRGB in [0, 1]; 0 rows: none
  Triangles triangles;      // t x 3; grouped by part, in the order of the mesh
  std::vector<Part> parts;  // cover all triangles, in order
  std::vector<SurfaceMaterial> materials;
};

struct SkinOptions {
  double max_edge = 0;       // m; edges longer than this are halved; 0: never
  double crease_angle = 60;  // degrees between neighbouring triangles; sharper edges stay sharp. Used where the mesh
                             // brings no normals of its own
};

/// Makes the skin of a mesh (already in metres). Deterministic.
[[nodiscard]] Skin make_skin(const SurfaceMesh& mesh, const SkinOptions& options);

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

/// Halves every edge longer than max_edge (m), again and again, with both its triangles, so that no gap opens: edges
/// that are equal by position are split alike. New vertices are appended; the first ones stay as they were.
void refine(Skin& skin, double max_edge);

}  // namespace sprung
