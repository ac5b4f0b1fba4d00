#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/types.h"

namespace sprung {

/// The appearance of a part's triangles. Colours are sRGB in [0, 1].
struct SurfaceMaterial {
  std::string name;
  Eigen::Vector4f color{0.8F, 0.8F, 0.8F, 1.0F};
  std::vector<std::byte> texture;  // an encoded image (PNG, JPEG, ...) that modulates color; empty: none
  std::string texture_name;        // for messages
};

/// Consecutive triangles with a common name and material.
struct Part {
  std::string name;
  int first_triangle = 0;
  int triangle_count = 0;
  int material = -1;  // index into materials; -1: none given
};

/// A triangle mesh as read from a file, node transforms applied: vertices are split where normals or UVs differ.
struct SurfaceMesh {
  Points positions;                                                  // n x 3, file units
  Triangles triangles;                                               // t x 3
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals;  // n x 3, unit; 0 rows: none given
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uvs;      // n x 2, v up; 0 rows: none
  Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> colors;   // n x 4, sRGB in [0, 1]; 0 rows: none
  std::vector<Part> parts;                                           // cover all triangles, in order
  std::vector<SurfaceMaterial> materials;
  bool single_precision = false;   // positions were rounded to floats, in the file or by its reader
  std::vector<std::string> notes;  // what the reader left out, one sentence each: a texture not found, loose lines, ...
};

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
