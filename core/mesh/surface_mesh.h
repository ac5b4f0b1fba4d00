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

}  // namespace sprung
