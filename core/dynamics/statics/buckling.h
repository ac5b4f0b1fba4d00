#pragma once
#include <functional>

#include "core/body/stress.h"
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Linear buckling: the smallest factors by which loads have to grow for the body to leave its equilibrium, smallest
/// first, with the shapes in which it does.
struct BucklingModes {
  Eigen::VectorXd factors;  // n
  Eigen::MatrixXd shapes;   // 3 m x n, largest entry 1
};

/// For a body at rest in which the loads cause the Cauchy stresses `stresses` at its nodes (m x 6, Pa;
/// recover_stress()): (K + factor K_g) shape = 0 with the geometric stiffness of the solid in the bricks, K_g = sum
/// over bricks of the integral of grad N_a . stress grad N_b (Bathe, Finite Element Procedures, 6.8.2). Loads keep
/// their directions; negative factors, for reversed loads, are left out. Fewer than `count` if there are no more, or
/// only some that the search cannot tell from the effect of the loads. `between` may throw. Throws Error(kFailed) if
/// the search does not converge, Error(kBadInput) if the supports leave the body free to move.
[[nodiscard]] BucklingModes find_buckling(const Body& body, const Supports& supports, const StressTensors& stresses,
                                          int count, const std::function<void()>& between = {});

}  // namespace sprung
