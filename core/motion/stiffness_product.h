#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/body/corner_sums.h"

namespace sprung {

/// Takes down for multiply_stiffness() where a body's springs point when its nodes are at `positions` (m x 3, m): unit
/// vectors, 744 bytes a brick; none where it has no springs (Model::kFem).
void find_directions(const Body& body, const Points& positions, std::vector<double>& directions);

/// (stiffness K + damping K_along) u, 3 m, N: K the second derivative of a body's elastic energy where it stands,
/// K_along that of its springs along themselves, without the guard, where they point in `directions` (not read where
/// `damping` is zero). Exact, without any matrix; the same bits for any number of threads.
struct StiffnessFactors {
  double stiffness = 1;
  double damping = 0;
};
void multiply_stiffness(const Body& body, const StiffnessFactors& factors, const std::vector<double>& directions,
                        const Eigen::VectorXd& u, CornerSums& sums, Eigen::VectorXd& product);

}  // namespace sprung
