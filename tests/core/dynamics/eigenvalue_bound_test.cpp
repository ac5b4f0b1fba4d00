#include "core/dynamics/linear/eigenvalue_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace sprung {
namespace {

/// The bound over the largest eigenvalue of B A, for B diagonal.
template <class Number>
double bound_over_largest(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
  const Eigen::MatrixX<Number> matrix = a.cast<Number>();
  const Vector diagonal = b.cast<Number>();
  const double bound = bound_on_eigenvalues<Vector>(
      a.rows(), [&](const Vector& x, Vector& product) { product = matrix * x; },
      [&](const Vector& x, Vector& product) { product = diagonal.cwiseProduct(x); });
  const Eigen::MatrixXd symmetric = b.cwiseSqrt().asDiagonal() * a * b.cwiseSqrt().asDiagonal();
  return bound / Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues().maxCoeff();
}

/// Springs in a row, a few of them much stiffer, on masses that differ by a factor of ten.
Eigen::MatrixXd chain(int count) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i + 1 < count; ++i) {
    const double stiffness = i % 17 == 3 ? 4 : 1;
    matrix.block<2, 2>(i, i) += stiffness * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  }
  return matrix;
}

TEST(EigenvalueBound, IsATenthOverTheLargestAtMost) {
  for (const int count : {2, 5, 100, 1000}) {
    const Eigen::VectorXd inverse_masses = Eigen::VectorXd::LinSpaced(count, 1, 10);
    const double in_double = bound_over_largest<double>(chain(count), inverse_masses);
    EXPECT_GT(in_double, 1.02) << count;
    EXPECT_LT(in_double, 1.1 + 1e-9) << count;
    EXPECT_NEAR(bound_over_largest<float>(chain(count), inverse_masses), in_double, 2e-3) << count;
  }
}

/// As the stiffness of a body that is about to buckle.
TEST(EigenvalueBound, HoldsForMatricesThatAreNotPositiveDefinite) {
  const Eigen::MatrixXd matrix = chain(60) - 0.5 * Eigen::MatrixXd::Identity(60, 60);
  const double bound = bound_over_largest<double>(matrix, Eigen::VectorXd::Ones(60));
  EXPECT_GT(bound, 1.02);
  EXPECT_LT(bound, 1.1 + 1e-9);
}

TEST(EigenvalueBound, OfNothingIsZero) {
  const auto nothing = [](const Eigen::VectorXd& x, Eigen::VectorXd& product) { product = 0 * x; };
  const auto same = [](const Eigen::VectorXd& x, Eigen::VectorXd& product) { product = x; };
  EXPECT_EQ(bound_on_eigenvalues<Eigen::VectorXd>(5, nothing, same), 0);
}

}  // namespace
}  // namespace sprung
