#pragma once
#include <cmath>

#include "core/bricks/solid_moments.h"
#include "core/law/brick_vector.h"
#include "core/law/material.h"
#include "core/law/neo_hooke/bending.h"
#include "core/law/neo_hooke/mean_response.h"
#include "core/law/neo_hooke/twist.h"
#include "core/law/neo_hooke/warping.h"

namespace sprung {

/// A brick that knows how its solid lies in it: its volume answers the mean deformation, its second moments bending,
/// twist and warping, term by term. Full or cut by the surface, it is right to first order and at any strain; momentum
/// and angular momentum are conserved exactly. As an element, a uniform-strain hexahedron with physical hourglass
/// stabilisation (Flanagan, Belytschko, Int. J. Numer. Meth. Engng 17, 1981; Puso, 49, 2000) whose stabilisation is
/// written in the squared lengths of twelve edges and twelve face diagonals. Plain, one brick at a time.
class SolidBrick {
 public:
  /// `h`: the brick's side, m; `fill`: solid volume over h^3, above 0; `moments` as bounded_moments() returns them.
  SolidBrick(const Material& material, double h, double fill, const SolidMoments& moments)
      : SolidBrick(material, h, fill * h * h * h, moments.centroid, fill * std::pow(h, 5) * moments.covariance) {}

  /// J, for corners at x (m), as in all that follows.
  [[nodiscard]] double energy(const BrickVector& x) const {
    return mean_.energy(x) + bending_.energy(x) + twist_.energy(x) + warping_.energy(x);
  }

  /// Minus the gradient of the energy, N.
  [[nodiscard]] BrickVector forces(const BrickVector& x) const {
    BrickVector forces = BrickVector::Zero();
    each_term([&](const auto& term) { term.add_forces(x, forces); });
    return forces;
  }

  /// The second derivative of the energy, N/m; `definite`: of each term without negative curvature.
  [[nodiscard]] BrickMatrix hessian(const BrickVector& x, bool definite) const {
    BrickMatrix matrix = BrickMatrix::Zero();
    each_term([&](const auto& term) { term.add_hessian(x, definite, matrix); });
    return matrix;
  }

  /// What stiffness-proportional damping sees, N/m: positive semidefinite, and zero for rigid motions wherever the
  /// brick is. At rest the Hessian.
  [[nodiscard]] BrickMatrix damping(const BrickVector& x) const {
    BrickMatrix matrix = BrickMatrix::Zero();
    each_term([&](const auto& term) { term.add_damping(x, matrix); });
    return matrix;
  }

  /// The same times v, N/m times what v is.
  [[nodiscard]] BrickVector damping_product(const BrickVector& x, const BrickVector& v) const {
    BrickVector product = BrickVector::Zero();
    each_term([&](const auto& term) { term.add_damping_product(x, v, product); });
    return product;
  }

  /// The deformation gradient at the centroid of the solid.
  [[nodiscard]] Mat3 gradient(const BrickVector& x) const { return mean_.gradient(x); }

 private:
  SolidBrick(const Material& material, double h, double volume, const Vec3& centroid, const Mat3& second)
      : mean_(material, h, volume, centroid),
        bending_(bending_term(material, h, centroid, second)),
        twist_(twist_term(material, h, second)),
        warping_(warping_term(material, h, volume, second)) {}

  template <class Call>
  void each_term(const Call& call) const {
    call(mean_);
    call(bending_);
    call(twist_);
    call(warping_);
  }

  MeanResponse mean_;
  SquareTerm<6> bending_;
  SquareTerm<3> twist_;
  SquareTerm<3> warping_;
};

/// Moments that the law can bear: in no direction is the solid thinner than `least_thickness` (brick lengths), and no
/// bending sets energy free (stable_moments()).
[[nodiscard]] SolidMoments bounded_moments(const Material& material, const SolidMoments& moments,
                                           double least_thickness = 0.02);

}  // namespace sprung
