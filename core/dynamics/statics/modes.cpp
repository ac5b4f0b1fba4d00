#include "core/dynamics/statics/modes.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <iostream>  // ArpackSupport needs it
#include <numbers>
#include <unsupported/Eigen/ArpackSupport>

#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/free_motion.h"
#include "core/error.h"

namespace sprung {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using ModeSolver = Eigen::ArpackGeneralizedSelfAdjointEigenSolver<Matrix, Eigen::SimplicialLLT<Matrix>>;

constexpr double kNoFrequency = 1e-11;  // squared, over the fastest: rounding

/// The smallest eigenvalues and their vectors. False where the matrix is not positive definite but for rounding.
bool solve(const Matrix& matrix, int count, ModeSolver& solver) {
  // The solver would say so on stdout itself.
  if (Eigen::SimplicialLLT<Matrix>(matrix).info() != Eigen::Success) return false;
  solver.compute(matrix, count, "SM");
  if (solver.info() == Eigen::Success) {
    return solver.eigenvalues().minCoeff() > kNoFrequency * matrix.diagonal().maxCoeff();
  }
  throw Error(ErrorKind::kFailed, fmt::format("the search for {} modes did not converge; hold more of the body or "
                                              "ask for fewer",
                                              count));
}

}  // namespace

Modes natural_modes(const Body& body, const Supports& supports, int count) {
  const FreeDofs dofs(supports);
  if (count < 1 || count >= dofs.count) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("cannot find {} modes of a body with {} free coordinates", count, dofs.count));
  }
  Eigen::VectorXd masses(3 * body.node_count());
  for (int i = 0; i < masses.size(); ++i) masses[i] = body.masses[i / 3];
  const Eigen::VectorXd scale = dofs.gather(masses).cwiseSqrt().cwiseInverse();

  // With shape = M^-1/2 y the problem becomes an ordinary symmetric one.
  Matrix matrix = stiffness_matrix(body, dofs, false, {});
  matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
  ModeSolver solver;
  if (!solve(matrix.selfadjointView<Eigen::Lower>(), count, solver)) {
    throw_if_free(body, supports, "there are no vibrations to find");
    throw Error(ErrorKind::kFailed, "the body is nearly free to move: hold more of it");
  }
  Modes modes;
  modes.frequencies.resize(count);
  modes.shapes.resize(masses.size(), count);
  for (int k = 0; k < count; ++k) {
    // ARPACK hands the smallest ones over from the largest to the smallest.
    const int from = solver.eigenvalues()[0] > solver.eigenvalues()[count - 1] ? count - 1 - k : k;
    modes.frequencies[k] = std::sqrt(solver.eigenvalues()[from]) / (2 * std::numbers::pi);
    modes.shapes.col(k) = dofs.scatter(scale.cwiseProduct(solver.eigenvectors().col(from)));
  }
  return modes;
}

}  // namespace sprung
