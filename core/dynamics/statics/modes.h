#pragma once
#include <functional>

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// The slowest natural vibrations of a body about the positions it has.
struct Modes {
  Eigen::VectorXd frequencies;  // k, Hz, slowest first
  int rigid = 0;                // motions of a free body, set aside: 6
  Eigen::MatrixXd shapes;       // 3 m x k, scaled so that shape^T masses shape = 1 kg m^2
};

/// The `count` slowest vibrations of the supported, undamped body: K shape = (2 pi f)^2 M shape with lumped masses, by
/// Davidson's method (Spectra) with multigrid: time and memory grow with the body. The squares of the frequencies are
/// right to a ten-thousandth of the lowest, clusters included. The supports must hold the body entirely, or not at
/// all: of a free body its six rigid motions are set aside. `between` is called before each of the matrix's products
/// and may throw. Throws Error(kBadInput) where the supports hold a part, Error(kFailed) where the iteration does not
/// converge or a free body falls apart.
[[nodiscard]] Modes natural_modes(const Body& body, const Supports& supports, int count,
                                  const std::function<void()>& between = {});

}  // namespace sprung
