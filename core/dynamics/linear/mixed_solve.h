#pragma once
#include <Eigen/Core>
#include <functional>

#include "core/dynamics/linear/linear_solver.h"
#include "core/dynamics/linear/volume_pressures.h"

namespace sprung {

/// K u = f with displacements u and the pressures of VolumePressures as unknowns:
///   A u + G p = f,  G^T u - S^-1 p = 0
struct MixedSystem {
  VolumePressures& volumes;
  std::function<void(const Eigen::VectorXd& u, Eigen::VectorXd& forces)> multiply;      // K u
  std::function<void(const Eigen::VectorXd& forces, Eigen::VectorXd& u)> precondition;  // approximately A^-1
};

/// Solves it by flexible GMRES (Saad, SIAM J. Sci. Comput. 14, 1993), preconditioned by the upper triangle of the
/// system's blocks and restarted with the residual of K u = f. `forces` are zero at fixed degrees of freedom, and so is
/// what multiply() returns. Otherwise like conjugate_gradients(): K is found not to be positive definite by its
/// curvature in the space that the iteration spans.
[[nodiscard]] Eigen::VectorXd solve_mixed(const MixedSystem& system, const Eigen::VectorXd& forces,
                                          const StoppingCriterion& end, SolveReport& report,
                                          Eigen::VectorXd* downhill = nullptr);

}  // namespace sprung
