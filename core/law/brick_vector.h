#pragma once
#include <Eigen/Core>

namespace sprung {

/// What the eight corners of a brick have, x y z corner by corner: places in m, forces in N.
using BrickVector = Eigen::Matrix<double, 24, 1>;
/// A stiffness by these, N/m.
using BrickMatrix = Eigen::Matrix<double, 24, 24>;

}  // namespace sprung
