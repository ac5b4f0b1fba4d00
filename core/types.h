#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sprung {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// n x 3: one point or vector a row, stored row by row (x y z x y z ...).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// n x 3: the three vertex indices of a triangle a row, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

}  // namespace sprung
