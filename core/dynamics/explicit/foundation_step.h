#pragma once
#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// The foundations of a body in explicit steps. They are far stiffer than bricks, so they act by backward Euler: after
/// a kick for the time k and before a drift for the time s, the velocities satisfy
///
///   M (v' - v) = k K (d - u - s v'),
///
/// K the springs, u the displacements and d those that the springs pull to at the end of the drift. Stable for any
/// step; what is at rest is where the springs balance it. Costs nothing without foundations. Deterministic.
class FoundationStep {
 public:
  /// `elapsed`: s, since the foundations of the body were as it has them.
  FoundationStep(const SoftBody& body, double elapsed);

  /// Changes the velocities of a body at its positions after a kick of `kick`, before a drift of `step` (s).
  void apply(SoftBody& body, double kick, double step);
  /// Moves the foundations by a drift (s).
  void pass(double step);

 private:
  void factorize(const SoftBody& body, double kick_step);

  std::vector<SpringSupport> springs_;       // as they are now
  std::vector<int> nodes_;                   // that they pull, ascending
  std::vector<std::array<int, 8>> corners_;  // by spring: rows of these
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> system_;  // M + k s K
  double factorized_for_ = 0;                                  // s^2, k s
};

}  // namespace sprung
