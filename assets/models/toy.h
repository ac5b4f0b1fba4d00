#pragma once
#include "core/types.h"

namespace sprung::models {

/// What is written to a file. Metres; single precision because that is what the file holds.
struct Toy {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> positions;       // n x 3
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals;         // n x 3, unit; 0 rows: none
  Eigen::Matrix<unsigned char, Eigen::Dynamic, 3, Eigen::RowMajor> colors;  // n x 3, sRGB; 0 rows: none
  Triangles triangles;                                                      // t x 3, outward
};

}  // namespace sprung::models
