#pragma once
#include <functional>

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// The slowest natural vibrations of a body about its current positions.
struct Modes {
  Eigen::VectorXd frequencies;  // k, Hz, slowest first
  int rigid = 0;                // motions, set aside: 6 of a free body
  Eigen::MatrixXd shapes;       // 3 m x k, scaled so that shape^T masses shape = 1 kg m^2
};

/// The `count` slowest vibrations of the supported, undamped body: K shape = (2 pi f)^2 M shape with lumped masses, by
/// Davidson's method (Spectra) with multigrid: time and memory grow with the body. The squares of the frequencies are
/// accurate to a ten-thousandth of the lowest, clusters included. Rigid motions that the supports leave, six of a free
/// body, are set aside. `between` is called before each matrix product and may throw. Throws Error(kBadInput) for more
/// modes than free coordinates, Error(kFailed) if the iteration does not converge or a body falls apart.
[[nodiscard]] Modes natural_modes(const Body& body, const Supports& supports, int count,
                                  const std::function<void()>& between = {});

}  // namespace sprung
