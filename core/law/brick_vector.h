#pragma once
#include <Eigen/Core>

namespace sprung {

/// A quantity at the eight corners of a brick, x y z corner by corner: positions in m, forces in N.
using BrickVector = Eigen::Matrix<double, 24, 1>;
/// A stiffness between these, N/m.
using BrickMatrix = Eigen::Matrix<double, 24, 24>;

}  // namespace sprung
