#pragma once
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// The slowest natural vibrations of a body about the positions it has.
struct Modes {
  Eigen::VectorXd frequencies;  // k, Hz, slowest first
  Eigen::MatrixXd shapes;       // 3 m x k, scaled so that shape^T masses shape = 1 kg m^2
};

/// The `count` slowest vibrations of the supported, undamped body: K shape = (2 pi f)^2 M shape with lumped masses, by
/// shift-invert Lanczos (ARPACK). The supports must hold the body entirely.
/// Throws Error(kBadInput) where they do not, Error(kFailed) where the iteration does not converge.
[[nodiscard]] Modes natural_modes(const Body& body, const Supports& supports, int count);

}  // namespace sprung
