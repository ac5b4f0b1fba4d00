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
constexpr int kRigidMotions = 6;
constexpr double kSpectralShift = 1e-3;  // of what a wave needs along a free body, which makes its matrix definite
constexpr double kRigid = 1e-5;          // of the shift: less than that is rounding

/// The square of the rate (1/s) at which a longitudinal wave runs along a body.
double wave_rate_squared(const Body& body) {
  const double length =
      (body.rest_positions.colwise().maxCoeff() - body.rest_positions.colwise().minCoeff()).maxCoeff();
  return body.material.young / body.material.density / (length * length);
}

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
  Modes modes;
  const bool is_free = dofs.count == masses.size();
  const double shift = is_free ? kSpectralShift * wave_rate_squared(body) : 0;
  if (is_free) {
    modes.rigid = kRigidMotions;
    for (int i = 0; i < dofs.count; ++i) matrix.coeffRef(i, i) += shift;
  }
  const int all = count + modes.rigid;
  ModeSolver solver;
  if (!solve(matrix.selfadjointView<Eigen::Lower>(), all, solver)) {
    throw_if_free(body, supports, "there are no vibrations to find");
    throw Error(ErrorKind::kFailed, "the body is nearly free to move: hold more of it");
  }
  modes.frequencies.resize(count);
  modes.shapes.resize(masses.size(), count);
  for (int k = 0; k < all; ++k) {
    // ARPACK hands the smallest ones over from the largest to the smallest.
    const int from = solver.eigenvalues()[0] > solver.eigenvalues()[all - 1] ? all - 1 - k : k;
    const double square = solver.eigenvalues()[from] - shift;  // of the angular frequency
    if (is_free && (square < kRigid * shift) != (k < modes.rigid)) {
      throw Error(ErrorKind::kFailed, "the free body has not six rigid motions: its parts do not hang together");
    }
    if (k < modes.rigid) continue;
    modes.frequencies[k - modes.rigid] = std::sqrt(square) / (2 * std::numbers::pi);
    modes.shapes.col(k - modes.rigid) = dofs.scatter(scale.cwiseProduct(solver.eigenvectors().col(from)));
  }
  return modes;
}

}  // namespace sprung
