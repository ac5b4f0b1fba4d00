#include "core/law/solid/strain_energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

/// -log_volume log J + square_volume/2 (J - 1)^2, see volume_energy(), and its derivatives by J.
struct VolumeEnergy {
  double value;
  double slope;
  double curvature;

  VolumeEnergy(double log_volume, double square_volume, double j) : value(volume_energy(log_volume, square_volume, j)) {
    const double at = std::max(j, kLowestVolume);
    const double below = std::max(1 - j / kLowestVolume, 0.0);
    const double partly = std::min(below, 1.0);
    slope = -log_volume * (1 + below + kCollapseStiffening * partly * (below - 0.5 * partly)) / at;
    curvature = log_volume * (1 + kCollapseStiffening * partly) / (at * at);
    const double u = j - 1;
    if (square_volume >= 0) {
      slope += square_volume * u;
      curvature += square_volume;
    } else {
      const double bound = 1 / (1 + u * u);
      slope += square_volume * u * bound * bound;
      curvature += square_volume * (1 - 3 * u * u) * bound * bound * bound;
    }
  }
};

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

/// psi by the principal stretches s; k, a and b are the axes in cyclic order.
struct PrincipalEnergy {
  double value = 0;
  Vec3 slope = Vec3::Zero();
  Mat3 curvature = Mat3::Zero();
  Vec3 apart = Vec3::Zero();     // (slope_a - slope_b) / (s_a - s_b)
  Vec3 together = Vec3::Zero();  // (slope_a + slope_b) / (s_a + s_b)
};

/// psi by I1, I2 and J: value, and the derivatives that are not zero for any of the laws.
struct InvariantEnergy {
  double value = 0;
  double by_1 = 0;
  double by_2 = 0;
  double by_j = 0;
  double by_11 = 0;
  double by_1j = 0;
  double by_jj = 0;
};

InvariantEnergy of_invariants(const HyperelasticTerms& terms, double i1, double i2, double j) {
  const VolumeEnergy volume(terms.log_volume, terms.square_volume, j);
  InvariantEnergy psi{.value = volume.value, .by_j = volume.slope, .by_jj = volume.curvature};
  const double shear = terms.shear;
  switch (terms.kind) {
    case StrainEnergyKind::kNeoHooke:
      psi.value += 0.5 * shear * (i1 - 3);
      psi.by_1 = 0.5 * shear;
      break;
    case StrainEnergyKind::kMooneyRivlin:
      psi.value += terms.by_i1 * (i1 - 3) + terms.by_i2 * (i2 - 3);
      psi.by_1 = terms.by_i1;
      psi.by_2 = terms.by_i2;
      break;
    case StrainEnergyKind::kFung: {
      const Stiffening by(2 * terms.exponent / shear, 0.5 * shear * (i1 - 3) + volume.value);
      psi.value = by.energy;
      psi.by_1 = 0.5 * shear * by.slope;
      psi.by_j = by.slope * volume.slope;
      psi.by_11 = 0.25 * shear * shear * by.curvature;
      psi.by_1j = 0.5 * shear * by.curvature * volume.slope;
      psi.by_jj = by.slope * volume.curvature + by.curvature * volume.slope * volume.slope;
      break;
    }
    case StrainEnergyKind::kLinear:
      psi.value = terms.lambda / 8 * (i1 - 3) * (i1 - 3) + 0.25 * shear * (i1 * i1 - 2 * i2 - 2 * i1 + 3);
      psi.by_1 = 0.25 * terms.lambda * (i1 - 3) + 0.5 * shear * (i1 - 1);
      psi.by_2 = -0.5 * shear;
      psi.by_11 = 0.25 * terms.lambda + 0.5 * shear;
      break;
    case StrainEnergyKind::kOgden:
      break;  // by stretches
  }
  return psi;
}

/// The terms of Ogden: f by the squared stretch c, and its derivatives.
struct OgdenEnergy {
  double value = 0;
  double slope = 0;
  double curvature = 0;

  OgdenEnergy(const HyperelasticTerms& terms, double c) {
    constexpr double kLeast = kLowestStretch * kLowestStretch;
    const double at = std::max(c, kLeast);
    for (const auto& [power, own_slope, own_energy] : terms.ogden) {
      const double here = own_slope * std::pow(at, power);
      slope += here;
      curvature += c < kLeast ? 0 : power * here / at;
      value += own_energy * (std::pow(at, power + 1) - 1);
    }
    value += slope * (c - at);
  }
};

/// (slope(c_a) - slope(c_b)) / (c_a - c_b).
double divided_difference(const HyperelasticTerms& terms, double a, double b) {
  constexpr double kClose = 1e-5;
  if (std::abs(a - b) <= kClose * (a + b)) return OgdenEnergy(terms, (a + b) / 2).curvature;
  return (OgdenEnergy(terms, a).slope - OgdenEnergy(terms, b).slope) / (a - b);
}

PrincipalEnergy principal_energy(const HyperelasticTerms& terms, const Vec3& s) {
  const Vec3 areas(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
  const Vec3 squares = s.cwiseAbs2();
  const double i1 = squares.sum();
  const InvariantEnergy psi = of_invariants(terms, i1, areas.squaredNorm(), s.prod());
  const Vec3 g1 = 2 * s;
  const Vec3 g2 = g1.cwiseProduct((i1 - squares.array()).matrix());
  PrincipalEnergy result;
  result.value = psi.value;
  result.slope = psi.by_1 * g1 + psi.by_2 * g2 + psi.by_j * areas;
  result.curvature = psi.by_11 * g1 * g1.transpose() + psi.by_1j * (g1 * areas.transpose() + areas * g1.transpose()) +
                     psi.by_jj * areas * areas.transpose();
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    result.curvature(k, k) += 2 * psi.by_1 + 2 * psi.by_2 * (i1 - squares[k]);
    const double across = 4 * psi.by_2 * s[a] * s[b] + psi.by_j * s[k];
    result.curvature(a, b) += across;
    result.curvature(b, a) += across;
    const double both = 2 * psi.by_1 + 2 * psi.by_2 * squares[k];
    result.apart[k] = both - (2 * psi.by_2 * s[a] * s[b] + psi.by_j * s[k]);
    result.together[k] = both + (2 * psi.by_2 * s[a] * s[b] + psi.by_j * s[k]);
  }
  if (terms.kind != StrainEnergyKind::kOgden) return result;
  for (int k = 0; k < 3; ++k) {
    const OgdenEnergy own(terms, squares[k]);
    result.value += own.value;
    result.slope[k] += 2 * s[k] * own.slope;
    result.curvature(k, k) += 2 * own.slope + 4 * squares[k] * own.curvature;
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    const double mean = OgdenEnergy(terms, squares[a]).slope + OgdenEnergy(terms, squares[b]).slope;
    const double difference = divided_difference(terms, squares[a], squares[b]);
    result.apart[k] += mean + (s[a] + s[b]) * (s[a] + s[b]) * difference;
    result.together[k] += mean + (s[a] - s[b]) * (s[a] - s[b]) * difference;
  }
  return result;
}

/// The second derivative by F; `definite`: without its negative eigenvalues.
GradientMatrix principal_hessian(const HyperelasticTerms& terms, const Mat3& gradient, bool definite) {
  const PrincipalStretches principal(gradient);
  const PrincipalEnergy psi = principal_energy(terms, principal.stretches);
  GradientMatrix result = GradientMatrix::Zero();
  const auto add = [&](const Mat3& direction, double eigenvalue) {
    if (definite && eigenvalue <= 0) return;
    const GradientVector d = flat(principal.u * direction * principal.v.transpose());
    result += eigenvalue * d * d.transpose();
  };
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    Mat3 twist = Mat3::Zero();
    twist(a, b) = -std::numbers::sqrt2 / 2;
    twist(b, a) = std::numbers::sqrt2 / 2;
    add(twist, psi.together[k]);
    add(twist.cwiseAbs(), psi.apart[k]);
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(psi.curvature);
  for (int k = 0; k < 3; ++k) {
    add(Vec3(solver.eigenvectors().col(k)).asDiagonal(), solver.eigenvalues()[k]);
  }
  return result;
}

}  // namespace

Mat3 cofactors(const Mat3& f) {
  Mat3 result;
  result << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
  return result;
}

double StrainEnergy::energy(const Mat3& gradient) const {
  if (terms_.kind == StrainEnergyKind::kOgden) {
    return principal_energy(terms_, PrincipalStretches(gradient).stretches).value;
  }
  return of_invariants(terms_, gradient.squaredNorm(), cofactors(gradient).squaredNorm(), gradient.determinant()).value;
}

Mat3 StrainEnergy::stress(const Mat3& gradient) const {
  if (terms_.kind == StrainEnergyKind::kNeoHooke) {
    const double pressure = VolumeEnergy(terms_.log_volume, terms_.square_volume, gradient.determinant()).slope;
    return terms_.shear * gradient + pressure * cofactors(gradient);
  }
  const PrincipalStretches principal(gradient);
  return principal.u * principal_energy(terms_, principal.stretches).slope.asDiagonal() * principal.v.transpose();
}

Vec3 StrainEnergy::principal_stress(const Vec3& stretches) const { return principal_energy(terms_, stretches).slope; }

GradientMatrix StrainEnergy::hessian(const Mat3& gradient) const {
  if (terms_.kind != StrainEnergyKind::kNeoHooke) return principal_hessian(terms_, gradient, false);
  const VolumeEnergy volume(terms_.log_volume, terms_.square_volume, gradient.determinant());
  const GradientVector areas = flat(cofactors(gradient));
  GradientMatrix result = terms_.shear * GradientMatrix::Identity() + volume.curvature * areas * areas.transpose();
  for (int a = 0; a < 3; ++a) {
    // The area that columns a + 1 and a + 2 span changes with both.
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    result.block<3, 3>(3 * a, 3 * b) -= volume.slope * cross_product_matrix(gradient.col(c));
    result.block<3, 3>(3 * a, 3 * c) += volume.slope * cross_product_matrix(gradient.col(b));
  }
  return result;
}

GradientMatrix StrainEnergy::definite_hessian(const Mat3& gradient) const {
  return principal_hessian(terms_, gradient, true);
}

Mat3 StrainEnergy::viscous_stress(const Mat3& gradient, const Mat3& rate) const {
  const Mat3 product = gradient.transpose() * rate;
  const Mat3 strain_rate = 0.5 * (product + product.transpose());
  return gradient * (terms_.lambda * strain_rate.trace() * Mat3::Identity() + 2 * terms_.shear * strain_rate);
}

GradientMatrix StrainEnergy::viscosity(const Mat3& gradient) const {
  GradientMatrix matrix;
  for (int entry = 0; entry < 9; ++entry) {
    Mat3 rate = Mat3::Zero();
    rate(entry % 3, entry / 3) = 1;
    matrix.col(entry) = flat(viscous_stress(gradient, rate));
  }
  return matrix;
}

}  // namespace sprung
