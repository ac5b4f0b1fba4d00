#include "core/dynamics/statics/modes.h"

#include <Spectra/JDSymEigsBase.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include "core/dynamics/linear/stiffness.h"
#include "core/error.h"

namespace sprung {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kDense = 600;             // degrees of freedom, up to which all vibrations are found at once
constexpr double kNoFrequency = 1e-11;  // squared, over the fastest: rounding
constexpr double kResidual = 1e-4;      // of the lowest eigenvalue, which bounds the error of each
constexpr int kMoreToStart = 8;         // vectors than vibrations
constexpr int kRoundsToStart = 2;       // of inverse iteration, about
constexpr int kMaxRounds = 200;         // of corrections
constexpr int kRoundsToRestart = 2;     // of corrections; each keeps as many vectors more
constexpr int kRigidMotions = 6;
constexpr double kSpectralShift = 1e-3;  // relative to a wave's rate along a free body; makes its matrix definite
constexpr double kRigid = 1e-5;          // of the shift: less than that is rounding

/// The square of the rate (1/s) at which a longitudinal wave travels along a body.
double wave_rate_squared(const Body& body) {
  const double length =
      (body.rest_positions.colwise().maxCoeff() - body.rest_positions.colwise().minCoeff()).maxCoeff();
  return body.material.young / body.material.density / (length * length);
}

/// M^-1/2 (K + shift M) M^-1/2 over the free degrees of freedom: with shape = M^-1/2 y the problem becomes an ordinary
/// symmetric one.
class ScaledStiffness {
 public:
  using Scalar = double;

  ScaledStiffness(const Body& body, const Supports& supports, double shift, const std::function<void()>& between)
      : body_(body), supports_(supports), dofs_(supports), terms_(support_terms(supports)), between_(between) {
    terms_.mass_factor = shift;
    Vector masses(3 * body.node_count());
    for (Eigen::Index i = 0; i < masses.size(); ++i) masses[i] = body.masses[i / 3];
    scale_ = dofs_.gather(masses).cwiseSqrt().cwiseInverse();
  }

  [[nodiscard]] Eigen::Index rows() const { return dofs_.count; }
  [[nodiscard]] Eigen::Index cols() const { return dofs_.count; }

  /// All entries, of a small body.
  [[nodiscard]] Matrix dense() const {
    const Matrix lower = stiffness_matrix(body_, dofs_, false, terms_);
    return scale_.asDiagonal() * Matrix(lower.selfadjointView<Eigen::Lower>()) * scale_.asDiagonal();
  }

  /// False if the matrix is found not to be positive definite.
  bool prepare() { return system_->linearize(body_, supports_, false, terms_); }

  [[nodiscard]] Matrix operator*(const Matrix& columns) const {
    return each(
        columns, [&](const Vector& all, Vector& product) { system_->multiply(all, product); }, scale_);
  }

  /// An approximate inverse.
  [[nodiscard]] Matrix precondition(const Matrix& columns) const {
    return each(
        columns, [&](const Vector& all, Vector& correction) { system_->precondition(all, correction); },
        scale_.cwiseInverse());
  }

  [[nodiscard]] Vector shape_of(const Vector& scaled) const { return dofs_.scatter(scale_.cwiseProduct(scaled)); }

 private:
  template <class Apply>
  [[nodiscard]] Matrix each(const Matrix& columns, const Apply& apply, const Vector& scale) const {
    Matrix results(columns.rows(), columns.cols());
    Vector result(3 * body_.node_count());
    for (Eigen::Index column = 0; column < columns.cols(); ++column) {
      if (between_) between_();
      apply(dofs_.scatter(scale.cwiseProduct(columns.col(column))), result);
      results.col(column) = scale.cwiseProduct(dofs_.gather(result));
    }
    return results;
  }

  const Body& body_;
  const Supports& supports_;
  FreeDofs dofs_;
  StepTerms terms_;
  std::function<void()> between_;
  Vector scale_;
  std::unique_ptr<IterativeSolver> system_ = make_multigrid_solver();
};

Matrix orthonormal(const Matrix& columns) {
  return Eigen::HouseholderQR<Matrix>(columns).householderQ() * Matrix::Identity(columns.rows(), columns.cols());
}

/// Davidson's method, with multigrid for the corrections.
class Davidson : public Spectra::JDSymEigsBase<Davidson, ScaledStiffness> {
 public:
  Davidson(ScaledStiffness& matrix, int count, int start)
      : JDSymEigsBase(matrix, count, start, start + kRoundsToRestart * count) {}

  /// Corrections for those that have not converged yet, one at least.
  [[nodiscard]] Matrix calculate_correction_vector() const {
    const Matrix& residuals = m_ritz_pairs.residues();
    std::vector<int> rows;
    for (int k = 0; k < m_correction_size; ++k) {
      if (!m_ritz_pairs.converged_eigenvalues()[k]) rows.push_back(k);
    }
    return m_matrix_operator.precondition(residuals(Eigen::all, rows));
  }
};

struct Eigenpairs {
  Vector values;   // smallest first
  Matrix vectors;  // orthonormal
};

Eigenpairs all_pairs(const ScaledStiffness& matrix, int count) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix.dense());
  return {solver.eigenvalues().head(count), solver.eigenvectors().leftCols(count)};
}

/// None if the matrix is not positive definite, or has an eigenvalue of at most `nothing`.
std::optional<Eigenpairs> smallest_pairs(ScaledStiffness& matrix, int count, double nothing) {
  if (!matrix.prepare()) return std::nullopt;
  const int start = count + kMoreToStart;
  std::mt19937_64 random(1);
  Matrix guess(matrix.rows(), start);
  for (double& number : guess.reshaped()) number = std::ldexp(double(random() >> 11U), -53) - 0.5;
  for (int round = 0; round < kRoundsToStart; ++round) guess = orthonormal(matrix.precondition(guess));
  const Matrix small = guess.transpose() * (matrix * guess);
  const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(small, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(lowest > nothing)) return std::nullopt;
  Davidson search(matrix, count, start);
  search.compute_with_guess(guess, Spectra::SortRule::SmallestAlge, kMaxRounds, kResidual * lowest);
  if (search.info() == Spectra::CompInfo::Successful) return Eigenpairs{search.eigenvalues(), search.eigenvectors()};
  throw Error(
      ErrorKind::kFailed,
      fmt::format("the search for {} modes did not converge; support more of the body or ask for fewer", count));
}

/// The same, by the method that suits the size.
std::optional<Eigenpairs> find_pairs(ScaledStiffness& matrix, int count, double nothing) {
  const bool is_small = matrix.rows() <= std::max(kDense, 4 * (count + kMoreToStart));
  std::optional<Eigenpairs> found = is_small ? all_pairs(matrix, count) : smallest_pairs(matrix, count, nothing);
  if (found && !(found->values[0] > nothing)) found.reset();
  return found;
}

}  // namespace

Modes natural_modes(const Body& body, const Supports& supports, int count, const std::function<void()>& between) {
  const FreeDofs dofs(supports);
  if (count < 1 || count >= dofs.count) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("cannot find {} modes of a body with {} free coordinates", count, dofs.count));
  }
  const double nothing = kNoFrequency * largest_brick_stiffness(body) / body.masses.maxCoeff();
  const bool is_free = dofs.count == 3 * body.node_count() && supports.springs.empty();
  double shift = 0;
  int all = count;
  std::optional<ScaledStiffness> matrix(std::in_place, body, supports, shift, between);
  std::optional<Eigenpairs> found;
  if (!is_free) found = find_pairs(*matrix, all, nothing);
  if (!found) {
    shift = kSpectralShift * wave_rate_squared(body);
    all = std::min(count + kRigidMotions, dofs.count);
    matrix.emplace(body, supports, shift, between);
    found = find_pairs(*matrix, all, 0);
  }
  if (!found) throw Error(ErrorKind::kFailed, "the body is nearly free to move: support more of it");
  Modes modes;
  while (modes.rigid < all && found->values[modes.rigid] - shift < kRigid * shift) ++modes.rigid;
  if (modes.rigid + count > all) {
    throw Error(ErrorKind::kFailed, "the body has more than six rigid motions: its parts are not connected");
  }
  modes.frequencies.resize(count);
  modes.shapes.resize(3 * body.node_count(), count);
  for (int k = 0; k < count; ++k) {
    const double square = found->values[modes.rigid + k] - shift;  // of the angular frequency
    modes.frequencies[k] = std::sqrt(square) / (2 * std::numbers::pi);
    modes.shapes.col(k) = matrix->shape_of(found->vectors.col(modes.rigid + k));
  }
  return modes;
}

}  // namespace sprung
