#pragma once
#include <vector>

#include "core/mesh/surface_mesh.h"
#include "core/types.h"

namespace sprung {

using Floats3 = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Floats2 = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Floats4 = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The surface of a body at rest, for drawing and contact. Finer than the mesh: vertices at creases are split so that
/// each has one normal, and long edges are halved until they can follow a bending brick.
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
  bool is_smooth = false;    // for drawing; see split_at_creases()
};

/// Makes the skin of a mesh (already in metres). Deterministic.
[[nodiscard]] Skin make_skin(const SurfaceMesh& mesh, const SkinOptions& options);

/// Vertices split so that each has one normal.
struct SplitVertices {
  std::vector<int> source;  // k; the mesh vertex that each split vertex copies
  Points normals;           // k x 3, unit
  Triangles triangles;      // t x 3, indices of split vertices
};

/// Normals for drawing. The mesh's own are kept (flipped where they point inwards); without any, corners at one point
/// share the angle-weighted mean normal of their triangles where these meet at less than `crease_angle` degrees, so
/// that sharp edges stay sharp. If it is to be `is_smooth`, normals of the mesh that only repeat those of its triangles
/// are ignored, triangles weigh also by the area of the flat face they are part of, and edges of flat faces of several
/// triangles are sharp from 35 degrees on.
[[nodiscard]] SplitVertices split_at_creases(const SurfaceMesh& mesh, double crease_angle, bool is_smooth = false);

/// Repeatedly halves every edge longer than max_edge (m) together with its triangles. Edges of equal positions are
/// split alike, so that no gap opens. New vertices are appended; the others stay unchanged.
void refine(Skin& skin, double max_edge);

/// As refine(), for drawing: halves edges and places the new vertices on curves at right angles to the normals of the
/// edges' ends, until edges lie within `tolerance` (m) of their curves, so that a coarse mesh looks smooth. Sharp edges
/// stay sharp and follow the crease; flat parts stay as they are. Edges of equal positions get equal curves. The curves
/// are those of A. Vlachos et al., "Curved PN triangles" (2001), with derivatives that make arcs of circles exact. For
/// skins that refine() has not changed: its new vertices lie on the chords. Deterministic.
void refine_curves(Skin& skin, double tolerance);

}  // namespace sprung
