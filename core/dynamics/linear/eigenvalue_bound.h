#pragma once
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/types.h"

namespace sprung {

/// A bound on the eigenvalues of B A, a tenth above the estimate of ten steps of Lanczos' method from a random vector
/// (a few per cent less than the largest, at worst). A and B are symmetric, B positive definite; multiply(x, product)
/// sets A x, precondition(x, product) B x, of vectors of `size`; 0 if A is zero. Source: Saad, "Iterative Methods for
/// Sparse Linear Systems", 2nd ed., SIAM 2003, section 6.7.3: the tridiagonal matrix from the coefficients of conjugate
/// gradients.
template <class Vector, class Multiply, class Precondition>
double bound_on_eigenvalues(Eigen::Index size, const Multiply& multiply, const Precondition& precondition) {
  constexpr int kSteps = 10;
  constexpr double kMargin = 1.1;
  using Number = typename Vector::Scalar;
  const auto dot = [](const Vector& a, const Vector& b) {
    return a.template cast<double>().dot(b.template cast<double>());
  };
  std::mt19937 random(1);
  Vector residual(size);
  for (Number& entry : residual) entry = Number(double(random()) / double(std::mt19937::max()) - 0.5);
  Vector ahead;
  Vector product;
  precondition(residual, ahead);
  Vector direction = ahead;
  double descent = dot(residual, ahead);
  const double rounding = 100 * double(std::numeric_limits<Number>::epsilon());
  const double least = rounding * descent;
  std::vector<double> diagonal;
  std::vector<double> beside;
  double carried = 0;
  while (isize(diagonal) < kSteps && descent > least) {
    multiply(direction, product);
    const double inverse_step = dot(direction, product) / descent;
    const double largest_rounding = diagonal.empty() ? 0 : rounding * std::abs(diagonal.front());
    if (!(std::abs(inverse_step) > largest_rounding)) break;  // only the null space of A is left
    diagonal.push_back(inverse_step + carried);
    residual -= Number(1 / inverse_step) * product;
    precondition(residual, ahead);
    const double next = dot(residual, ahead);
    const double growth = std::max(next / descent, 0.0);
    carried = growth * inverse_step;
    beside.push_back(std::sqrt(growth) * inverse_step);
    direction = ahead + Number(growth) * direction;
    descent = next;
  }
  if (diagonal.empty()) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Map(diagonal.data(), isize(diagonal)),
                                Eigen::VectorXd::Map(beside.data(), isize(diagonal) - 1), Eigen::EigenvaluesOnly);
  return kMargin * solver.eigenvalues().maxCoeff();
}

}  // namespace sprung
