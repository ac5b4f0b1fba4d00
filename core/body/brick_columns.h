#pragma once
#include <array>

#include "core/bricks/corner.h"
#include "core/types.h"

namespace sprung {

/// What the eight corners of a brick have (places in m, velocities in m/s), a column each.
using BrickColumns = Eigen::Matrix<double, 3, 8>;

/// `nodes`: of the brick, by corner; `values`: per node of the body, m x 3.
[[nodiscard]] inline BrickColumns columns_of(const std::array<int, 8>& nodes, const Points& values) {
  BrickColumns columns;
  for (int corner = 0; corner < 8; ++corner) {
    columns.col(corner) = values.row(nodes[static_cast<std::size_t>(corner)]).transpose();
  }
  return columns;
}

/// The mean axes (columns), each from the brick's low to its high side.
[[nodiscard]] inline Mat3 mean_axes_of(const BrickColumns& x) {
  Mat3 axes = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      axes.col(axis) += (on_high_side(corner, axis) ? 0.25 : -0.25) * x.col(corner);
    }
  }
  return axes;
}

/// Areas that three axes span two by two: the gradient of their determinant, and what carries normals along.
[[nodiscard]] inline Mat3 areas_of(const Mat3& axes) {
  Mat3 areas;
  areas << axes.col(1).cross(axes.col(2)), axes.col(2).cross(axes.col(0)), axes.col(0).cross(axes.col(1));
  return areas;
}

}  // namespace sprung
