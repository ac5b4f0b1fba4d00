#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "core/motion/newton_system.h"

namespace sprung {

/// When conjugate gradients end.
struct GradientsEnd {
  double tolerance;    // of the forces, left over
  double will_do = 0;  // likewise, where the iterations run out
  int max_iterations;
};

/// Solves A x = forces by flexible conjugate gradients (Polak-Ribiere: rounding makes a preconditioner not quite the
/// same in each iteration), by multiply(x, product) and precondition(residual, answer). `forces` and what these give
/// are zero where A is. Empty where A is not positive definite, or no answer is found.
template <class Multiply, class Precondition>
Eigen::VectorXd conjugate_gradients(const Eigen::VectorXd& forces, const GradientsEnd& end, const Multiply& multiply,
                                    const Precondition& precondition, SolveReport& report) {
  ++report.solves;
  Eigen::VectorXd residual = forces;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(residual.size());
  const double goal = end.tolerance * forces.norm();
  if (goal == 0) return x;
  Eigen::VectorXd z;
  Eigen::VectorXd product;
  precondition(residual, z);
  Eigen::VectorXd direction = z;
  double descent = residual.dot(z);
  for (int iteration = 1; iteration <= end.max_iterations; ++iteration) {
    ++report.iterations;
    report.most = std::max(report.most, iteration);
    multiply(direction, product);
    const double curvature = direction.dot(product);
    if (!(curvature > 0)) {
      ++report.indefinite;
      return {};
    }
    const double step = descent / curvature;
    x += step * direction;
    residual -= step * product;
    if (residual.norm() <= goal) return x;
    precondition(residual, z);
    const double next = residual.dot(z);
    direction = z - step * z.dot(product) / descent * direction;
    descent = next;
    if (!(descent > 0)) break;
  }
  if (residual.norm() <= end.will_do * forces.norm()) return x;
  return {};
}

}  // namespace sprung
