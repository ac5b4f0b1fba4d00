#pragma once
#include <span>
#include <vector>

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Each body's own part of the couplings, for StepTerms::coupled: an upper bound of it. By body.
[[nodiscard]] std::vector<std::vector<PointStiffness>> own_parts(const std::vector<Coupling>& couplings,
                                                                 std::size_t bodies);

/// A body of a coupled system; `system` is linearized.
struct CoupledBody {
  const Body* body;
  const Supports* supports;
  IterativeSolver* system;
};

/// Solves for u under the forces (both one body after the other, 3 m each) with all bodies' K + terms and the couplings
/// between them: by conjugate gradients, each body preconditioned by itself. Stops and returns like
/// LinearSolver::solve(), except that a nearly converged solution is accepted if that takes too long. The same bits for
/// any number of threads.
[[nodiscard]] Eigen::VectorXd solve_coupled(std::span<const CoupledBody> bodies, const std::vector<Coupling>& couplings,
                                            const Eigen::VectorXd& forces, double tolerance, SolveReport& report);

}  // namespace sprung
