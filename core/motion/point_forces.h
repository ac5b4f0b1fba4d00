#pragma once
#include "core/body/brick_hessian.h"
#include "core/motion/newton_system.h"

namespace sprung {

/// Adds what holds a point to the matrix of its brick.
void add_point_stiffness(const PointStiffness& point, BrickMatrix& matrix);

/// Adds the forces (3 m, N) that hold the point while the nodes move by x (3 m, m).
void add_point_product(const Body& body, const PointStiffness& point, const Eigen::VectorXd& x,
                       Eigen::VectorXd& product);

}  // namespace sprung
