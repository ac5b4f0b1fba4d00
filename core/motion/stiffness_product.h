#pragma once
#include <vector>

#include "core/body/body.h"

namespace sprung {

/// (stiffness K + damping K_along) u, 3 m, N: K the second derivative of a body's elastic energy where it stands,
/// K_along that of its springs along themselves, without the guard, where its nodes are at `damping_positions` (m x 3,
/// m; not read where `damping` is zero). Exact, without any matrix; the same bits for any number of threads.
struct StiffnessFactors {
  double stiffness = 1;
  double damping = 0;
};
void multiply_stiffness(const Body& body, const StiffnessFactors& factors, const Points& damping_positions,
                        const Eigen::VectorXd& u, std::vector<double>& room, Eigen::VectorXd& product);

}  // namespace sprung
