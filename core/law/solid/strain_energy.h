#pragma once
#include <Eigen/Core>

#include "core/law/material.h"
#include "core/law/solid/hyperelastic_terms.h"
#include "core/types.h"

namespace sprung {

/// The nine entries of a deformation gradient, column by column.
using GradientVector = Eigen::Matrix<double, 9, 1>;
using GradientMatrix = Eigen::Matrix<double, 9, 9>;

/// The strain-energy density psi of a material, see StrainEnergyKind, finite for every F, inverted ones too: below
/// J = kLowestVolume log J continues as a cubic with its value, slope and curvature there, below J = 0 as a parabola,
/// below a stretch of kLowestStretch the terms of Ogden with the slope by the squared stretch that they have there, and
/// beyond kLargestExponent the exponential as a parabola. A block compressed along one axis carries more and more, at
/// nu = 0 and J = 0 325 E. Where the factor of (J - 1)^2 is negative (nu < 0 with most), (J - 1)^2 / (1 + (J - 1)^2)
/// takes its place: without a bound it would let a solid swell without end; with it psi grows with every dilation down
/// to nu = -1/2. Source: Bonet, Wood, "Nonlinear Continuum Mechanics for Finite Element Analysis", section 6.4.3, with
/// (J - 1)^2 instead of (log J)^2.
class StrainEnergy {
 public:
  explicit StrainEnergy(const Material& material) : StrainEnergy(hyperelastic_terms(material)) {}
  explicit StrainEnergy(const HyperelasticTerms& terms) : terms_(terms) {}

  /// J/m^3; 0 at rest.
  [[nodiscard]] double energy(const Mat3& gradient) const;
  /// First Piola-Kirchhoff stress d psi / d F, Pa.
  [[nodiscard]] Mat3 stress(const Mat3& gradient) const;
  /// The same for F = diag(stretches): the diagonal of the stress.
  [[nodiscard]] Vec3 principal_stress(const Vec3& stretches) const;
  /// d^2 psi / d F^2, Pa.
  [[nodiscard]] GradientMatrix hessian(const Mat3& gradient) const;
  /// The same without its negative eigenvalues. These are closed-form in the principal stretches, except for a 3 x 3
  /// block. Source: Smith, de Goes, Kim, "Analytic Eigensystems for Isotropic Distortion Energies", ACM TOG 38(1),
  /// 2019.
  [[nodiscard]] GradientMatrix definite_hessian(const Mat3& gradient) const;
  /// The first Piola-Kirchhoff stress of a Kelvin-Voigt solid, F (lambda tr(E') + 2 G E'), E' = sym(F^T F') the rate of
  /// Green's strain; Pa over the relaxation time. It opposes every deformation and vanishes for rigid motions.
  [[nodiscard]] Mat3 viscous_stress(const Mat3& gradient, const Mat3& rate) const;
  /// The same as a matrix: positive semidefinite.
  [[nodiscard]] GradientMatrix viscosity(const Mat3& gradient) const;

 private:
  HyperelasticTerms terms_;
};

/// The derivative of det F.
[[nodiscard]] Mat3 cofactors(const Mat3& f);

}  // namespace sprung
