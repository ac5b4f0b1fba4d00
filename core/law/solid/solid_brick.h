#pragma once
#include "core/bricks/solid_moments.h"
#include "core/law/brick_vector.h"
#include "core/law/material.h"
#include "core/law/solid/curved_solid.h"
#include "core/law/solid/strain_differences.h"
#include "core/law/solid/strain_energy.h"
#include "core/types.h"

namespace sprung {

/// A brick with a known distribution of its solid. Its energy, with z = (b, t, q) the differences of its springs'
/// squared lengths (StrainDifferences) and S, K those of its solid (CurvedSolid):
///   W = V psi(F (I + S z)) + 1/2 E V h^2 (b, t)^T K (b, t) + 3/2 sum over i: E m_jj m_kk / V q_i^2
/// With the law of Fung, this W of a neo-Hookean brick, over V, stands in its exponential: bending stiffens as strain.
/// F is the gradient of the trilinear map of the corners at the centroid. Full or cut by the surface, it is accurate to
/// first order and at any strain; momentum and angular momentum are conserved exactly. As an element, a uniform-strain
/// hexahedron with physical hourglass stabilisation (Flanagan, Belytschko, Int. J. Numer. Meth. Engng 17, 1981; Puso,
/// 49, 2000). Plain, one brick at a time.
class SolidBrick {
 public:
  /// `h`: the brick's side, m; `fill`: solid volume over h^3, above 0; `moments` as bounded_moments() returns them;
  /// `curved`: what follows from them.
  SolidBrick(const Material& material, double h, double fill, const SolidMoments& moments, const CurvedSolid& curved);
  SolidBrick(const Material& material, double h, double fill, const SolidMoments& moments)
      : SolidBrick(material, h, fill, moments, curved_solid(material.poisson, moments)) {}

  /// J, for corners at x (m), as in all that follows.
  [[nodiscard]] double energy(const BrickVector& x) const;
  /// Minus the gradient of the energy, N.
  [[nodiscard]] BrickVector forces(const BrickVector& x) const;
  /// The second derivative of the energy, N/m; `definite`: without negative curvature.
  [[nodiscard]] BrickMatrix hessian(const BrickVector& x, bool definite) const;
  /// The matrix of stiffness-proportional damping, N/m: positive semidefinite, and zero for rigid motions in any state.
  /// At rest, the Hessian.
  [[nodiscard]] BrickMatrix damping(const BrickVector& x) const;
  /// The same times v, N/m times the unit of v.
  [[nodiscard]] BrickVector damping_product(const BrickVector& x, const BrickVector& v) const;

  /// The deformation gradient at the centroid of the solid, F (I + S z).
  [[nodiscard]] Mat3 gradient(const BrickVector& x) const;
  /// The derivatives of its determinant by the corners, 1/m.
  [[nodiscard]] BrickVector volume_rates(const BrickVector& x) const;

 private:
  using Values = StrainDifferences::Values;
  using GradientRates = Eigen::Matrix<double, 9, 24>;  // of the nine entries of a gradient, by the corners

  /// The deformation for given corners.
  struct Deformation {
    Values z;
    Mat3 secant;  // F
    Mat3 bent;    // I + S z

    [[nodiscard]] Mat3 gradient() const { return secant * bent; }
  };
  [[nodiscard]] Deformation deformation(const BrickVector& x) const;
  [[nodiscard]] Mat3 secant(const BrickVector& x) const { return x.reshaped(3, 8) * weights_; }
  /// S z.
  [[nodiscard]] Mat3 shear(const Values& z) const {
    return shear_matrix(tangent_ * z.head<StrainDifferences::kGradients>());
  }
  /// The forces on the corners of a stress (first Piola-Kirchhoff, Pa) plus those of forces on the springs'
  /// differences.
  [[nodiscard]] BrickVector pull(const BrickVector& x, const Deformation& at, const Mat3& stress,
                                 const Values& besides) const;
  /// The forces of the stress F^T P (Pa) on the differences.
  [[nodiscard]] Values on_differences(const Mat3& stress) const;
  /// The rates of gradient().
  [[nodiscard]] GradientRates gradient_rates(const Deformation& at, const StrainDifferences::Rates& rates) const;

  /// The energy and its second derivative, of kFung those of what stands in its exponential.
  [[nodiscard]] double plain_energy(const Deformation& at) const;
  [[nodiscard]] BrickMatrix plain_hessian(const BrickVector& x, const Deformation& at, bool definite) const;
  [[nodiscard]] bool is_fung() const { return per_energy_ > 0; }

  StrainEnergy law_;  // of kFung: neo-Hookean
  double volume_;
  double per_energy_;                    // 2 b / (G V) of kFung, 1/J; else 0
  Eigen::Matrix<double, 8, 3> weights_;  // gradients of the corners' trilinear weights at the centroid, 1/m
  StrainDifferences differences_;
  Eigen::Matrix<double, StrainDifferences::kAll, StrainDifferences::kAll> stiffness_;  // of z
  Eigen::Matrix<double, 3, 9> tangent_;                                                // of (b, t), m
};

/// The energy of warping, over half E V, is q_i^2 h^4 times this.
[[nodiscard]] Vec3 warping_stiffness(const SolidMoments& moments);

/// Moments admissible for the law: in no direction is the solid thinner than `min_thickness`, in brick lengths, and its
/// centroid is no further than 0.45 of them from the middle along any axis. Corners far from a centroid have little
/// mass and set the largest stable step; that of a brick that has absorbed others may even be outside of it.
[[nodiscard]] SolidMoments bounded_moments(const SolidMoments& moments, double min_thickness = 0.02);

}  // namespace sprung
