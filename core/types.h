#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <iterator>

namespace sprung {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// n x 3: one point or vector a row, stored row by row (x y z x y z ...).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// n x 3: the three vertex indices of a triangle a row, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The weights of a brick's eight corners in a point; their sum is 1.
using CornerWeights = Eigen::Matrix<double, 8, 1>;

/// How many there are, as the type of indices: meshes and grids count in int, as their files and Eigen do.
template <class Container>
[[nodiscard]] constexpr int isize(const Container& container) {
  return int(std::size(container));
}

}  // namespace sprung
