#include "core/law/neo_hooke/strain_energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

/// The part of psi that depends on the volume ratio J, and its derivatives.
struct VolumeEnergy {
  double value;
  double slope;
  double curvature;

  VolumeEnergy(double shear, double lambda, double j) {
    const double at = std::max(j, kLowestVolume);
    const double below = std::min(j - kLowestVolume, 0.0) / kLowestVolume;
    value = -shear * (std::log(at) + below - 0.5 * below * below);
    slope = -shear * (1 - below) / at;
    curvature = shear / (at * at);
    const double u = j - 1;
    if (lambda >= 0) {
      value += 0.5 * lambda * u * u;
      slope += lambda * u;
      curvature += lambda;
    } else {
      const double bound = 1 / (1 + u * u);
      value += 0.5 * lambda * u * u * bound;
      slope += lambda * u * bound * bound;
      curvature += lambda * (1 - 3 * u * u) * bound * bound * bound;
    }
  }
};

/// d det F / d F.
Mat3 cofactors(const Mat3& f) {
  Mat3 result;
  result << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
  return result;
}

Mat3 cross_product_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

GradientVector flat(const Mat3& m) { return Eigen::Map<const GradientVector>(m.data()); }

using AtMost3 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// F = U diag(stretches) V^T with rotations U and V: for an inverted F the smallest stretch is negative.
struct PrincipalStretches {
  Mat3 u;
  Mat3 v;
  Vec3 stretches;

  explicit PrincipalStretches(const Mat3& f) {
    const Eigen::JacobiSVD<AtMost3, Eigen::NoQRPreconditioner> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    u = svd.matrixU();
    v = svd.matrixV();
    stretches = svd.singularValues();
    for (Mat3* side : {&u, &v}) {
      if (side->determinant() >= 0) continue;
      side->col(2) *= -1;
      stretches[2] *= -1;
    }
  }
};

}  // namespace

double volume_energy(double shear, double lambda, double ratio) { return VolumeEnergy(shear, lambda, ratio).value; }

NeoHooke::NeoHooke(const Material& material) : shear_(material.shear_modulus()), lambda_(material.lame_lambda()) {}

double NeoHooke::energy(const Mat3& gradient) const {
  return 0.5 * shear_ * (gradient.squaredNorm() - 3) + VolumeEnergy(shear_, lambda_, gradient.determinant()).value;
}

Mat3 NeoHooke::stress(const Mat3& gradient) const {
  const double pressure = VolumeEnergy(shear_, lambda_, gradient.determinant()).slope;
  return shear_ * gradient + pressure * cofactors(gradient);
}

GradientMatrix NeoHooke::hessian(const Mat3& gradient) const {
  const VolumeEnergy volume(shear_, lambda_, gradient.determinant());
  const GradientVector areas = flat(cofactors(gradient));
  GradientMatrix result = shear_ * GradientMatrix::Identity() + volume.curvature * areas * areas.transpose();
  for (int a = 0; a < 3; ++a) {
    // The area that columns a + 1 and a + 2 span changes with both.
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    result.block<3, 3>(3 * a, 3 * b) -= volume.slope * cross_product_matrix(gradient.col(c));
    result.block<3, 3>(3 * a, 3 * c) += volume.slope * cross_product_matrix(gradient.col(b));
  }
  return result;
}

GradientMatrix NeoHooke::definite_hessian(const Mat3& gradient) const {
  const PrincipalStretches principal(gradient);
  const Vec3& s = principal.stretches;
  const VolumeEnergy volume(shear_, lambda_, s.prod());
  GradientMatrix result = GradientMatrix::Zero();
  const auto add = [&](const Mat3& direction, double eigenvalue) {
    if (eigenvalue <= 0) return;
    const GradientVector d = flat(principal.u * direction * principal.v.transpose());
    result += eigenvalue * d * d.transpose();
  };
  const Vec3 areas(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
  Mat3 stretching = shear_ * Mat3::Identity() + volume.curvature * areas * areas.transpose();
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    Mat3 twist = Mat3::Zero();
    twist(a, b) = -std::numbers::sqrt2 / 2;
    twist(b, a) = std::numbers::sqrt2 / 2;
    add(twist, shear_ + volume.slope * s[k]);
    add(twist.cwiseAbs(), shear_ - volume.slope * s[k]);
    stretching(a, b) += volume.slope * s[k];
    stretching(b, a) += volume.slope * s[k];
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(stretching);
  for (int k = 0; k < 3; ++k) {
    add(Vec3(solver.eigenvectors().col(k)).asDiagonal(), solver.eigenvalues()[k]);
  }
  return result;
}

Mat3 NeoHooke::viscous_stress(const Mat3& gradient, const Mat3& rate) const {
  const Mat3 product = gradient.transpose() * rate;
  const Mat3 strain_rate = 0.5 * (product + product.transpose());
  return gradient * (lambda_ * strain_rate.trace() * Mat3::Identity() + 2 * shear_ * strain_rate);
}

GradientMatrix NeoHooke::viscosity(const Mat3& gradient) const {
  GradientMatrix matrix;
  for (int entry = 0; entry < 9; ++entry) {
    Mat3 rate = Mat3::Zero();
    rate(entry % 3, entry / 3) = 1;
    matrix.col(entry) = flat(viscous_stress(gradient, rate));
  }
  return matrix;
}

}  // namespace sprung
