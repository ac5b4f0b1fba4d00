#pragma once
#include "core/body/body.h"
#include "core/body/corner_sums.h"
#include "core/body/spring_system.h"

namespace sprung {

/// Room for the products of one body, kept from one to the next.
struct ProductWorkspace {
  CornerSums sums;
  SpringSystem springs;
};

/// K u, 3 m, N: K the second derivative of a body's elastic energy where it stands. Exact, without any matrix; the same
/// bits for any number of threads.
void multiply_stiffness(const Body& body, const Eigen::VectorXd& u, ProductWorkspace& workspace,
                        Eigen::VectorXd& product);

/// factor K_along u, likewise: K_along the stiffness that damping sees, that of the springs along themselves, without
/// the guard, with nodes at `positions` (m x 3, m).
void multiply_damping(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      ProductWorkspace& workspace, Eigen::VectorXd& product);

}  // namespace sprung
