#include "core/law/solid/solid_brick.h"

#include <Eigen/Eigenvalues>

#include "core/bricks/embedding.h"

namespace sprung {
namespace {

constexpr int kGradients = StrainDifferences::kGradients;
constexpr double kFarthestCentroid = 0.45;  // brick lengths, along each axis
constexpr double kWarping = 3;              // over a plate's E m m; less leaves bodies of slanted bricks softer still

/// Of the law of Fung, what stands in the exponential.
HyperelasticTerms plain_terms(const Material& material) {
  HyperelasticTerms terms = hyperelastic_terms(material);
  if (terms.kind == StrainEnergyKind::kFung) terms.kind = StrainEnergyKind::kNeoHooke;
  return terms;
}

}  // namespace

SolidBrick::SolidBrick(const Material& material, double h, double fill, const SolidMoments& moments,
                       const CurvedSolid& curved)
    : law_(plain_terms(material)),
      volume_(fill * h * h * h),
      per_energy_(2 * material.law.fung_exponent.value_or(0) / (material.shear_modulus() * volume_)),
      weights_(trilinear_gradients(Vec3::Constant(0.5) + moments.centroid) / h),
      differences_(h, moments.centroid),
      tangent_(h * curved.tangent) {
  const double bending = material.young * volume_ * h * h;
  stiffness_.setZero();
  stiffness_.topLeftCorner<kGradients, kGradients>() = bending * curved.stiffness;
  stiffness_.diagonal().tail<3>() = bending * h * h * warping_stiffness(moments);
}

SolidBrick::Deformation SolidBrick::deformation(const BrickVector& x) const {
  const Values z = differences_.values(x);
  return {.z = z, .secant = secant(x), .bent = Mat3::Identity() + shear(z)};
}

double SolidBrick::plain_energy(const Deformation& at) const {
  return volume_ * law_.energy(at.gradient()) + 0.5 * at.z.dot(stiffness_ * at.z);
}

double SolidBrick::energy(const BrickVector& x) const {
  const double plain = plain_energy(deformation(x));
  return is_fung() ? Stiffening(per_energy_, plain).energy : plain;
}

BrickVector SolidBrick::forces(const BrickVector& x) const {
  const Deformation at = deformation(x);
  const BrickVector plain = -pull(x, at, law_.stress(at.gradient()), stiffness_ * at.z);
  return is_fung() ? BrickVector(Stiffening(per_energy_, plain_energy(at)).slope * plain) : plain;
}

BrickMatrix SolidBrick::hessian(const BrickVector& x, bool definite) const {
  const Deformation at = deformation(x);
  BrickMatrix matrix = plain_hessian(x, at, definite);
  if (is_fung()) {
    const Stiffening by(per_energy_, plain_energy(at));
    const BrickVector slope = pull(x, at, law_.stress(at.gradient()), stiffness_ * at.z);
    matrix *= by.slope;
    matrix += by.curvature * slope * slope.transpose();
  }
  return matrix;
}

BrickMatrix SolidBrick::plain_hessian(const BrickVector& x, const Deformation& at, bool definite) const {
  const StrainDifferences::Rates rates = differences_.rates(x);
  const GradientRates of_gradient = gradient_rates(at, rates);
  const Mat3 gradient = at.gradient();
  const Mat3 stress = law_.stress(gradient);
  BrickMatrix matrix = rates.transpose() * stiffness_ * rates;
  matrix += volume_ * of_gradient.transpose() * (definite ? law_.definite_hessian(gradient) : law_.hessian(gradient)) *
            of_gradient;
  differences_.add_curvature(stiffness_ * at.z + on_differences(at.secant.transpose() * stress), definite, matrix);
  if (definite) return matrix;
  // F and S change together.
  Eigen::Matrix<double, kGradients, 24> of_secant;
  for (int row = 0; row < kGradients; ++row) {
    const Mat3 on_secant = volume_ * stress * shear_matrix(tangent_.col(row));
    of_secant.row(row) = (on_secant * weights_.transpose()).reshaped().transpose();
  }
  const BrickMatrix together = of_secant.transpose() * rates.topRows<kGradients>();
  return matrix + together + together.transpose();
}

BrickMatrix SolidBrick::damping(const BrickVector& x) const {
  const Deformation at = deformation(x);
  const StrainDifferences::Rates rates = differences_.rates(x);
  const GradientRates of_gradient = gradient_rates(at, rates);
  return volume_ * of_gradient.transpose() * law_.viscosity(at.gradient()) * of_gradient +
         rates.transpose() * stiffness_ * rates;
}

BrickVector SolidBrick::damping_product(const BrickVector& x, const BrickVector& v) const {
  const Deformation at = deformation(x);
  const Values change = differences_.change(x, v);
  const Mat3 rate = secant(v) * at.bent + at.secant * shear(change);
  return pull(x, at, law_.viscous_stress(at.gradient(), rate), stiffness_ * change);
}

Mat3 SolidBrick::gradient(const BrickVector& x) const { return deformation(x).gradient(); }

BrickVector SolidBrick::volume_rates(const BrickVector& x) const {
  const Deformation at = deformation(x);
  return pull(x, at, cofactors(at.gradient()), Values::Zero()) / volume_;
}

BrickVector SolidBrick::pull(const BrickVector& x, const Deformation& at, const Mat3& stress,
                             const Values& besides) const {
  BrickVector pull = differences_.pull(x, besides + on_differences(at.secant.transpose() * stress));
  pull.reshaped(3, 8) += volume_ * stress * at.bent * weights_.transpose();
  return pull;
}

SolidBrick::Values SolidBrick::on_differences(const Mat3& stress) const {
  const Vec3 rows(stress(1, 2) + stress(2, 1), stress(2, 0) + stress(0, 2), stress(0, 1) + stress(1, 0));
  Values values = Values::Zero();
  values.head<kGradients>() = volume_ * tangent_.transpose() * rows;
  return values;
}

SolidBrick::GradientRates SolidBrick::gradient_rates(const Deformation& at,
                                                     const StrainDifferences::Rates& rates) const {
  const Eigen::Matrix<double, 8, 3> weights = weights_ * at.bent;
  GradientRates of_gradient = GradientRates::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      of_gradient.block<3, 3>(3 * axis, 3 * corner).diagonal().setConstant(weights(corner, axis));
    }
  }
  for (int row = 0; row < kGradients; ++row) {
    const Mat3 along = at.secant * shear_matrix(tangent_.col(row));
    of_gradient += along.reshaped() * rates.row(row);
  }
  return of_gradient;
}

Vec3 warping_stiffness(const SolidMoments& moments) {
  const Vec3 spread = moments.covariance.diagonal();
  return kWarping * Vec3(spread[1] * spread[2], spread[2] * spread[0], spread[0] * spread[1]);
}

SolidMoments bounded_moments(const SolidMoments& moments, double min_thickness) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments.covariance);
  const double least = min_thickness * min_thickness / 12;
  SolidMoments bounded = moments;
  bounded.centroid = moments.centroid.cwiseMax(-kFarthestCentroid).cwiseMin(kFarthestCentroid);
  if (axes.eigenvalues()[0] < least) {
    bounded.covariance =
        axes.eigenvectors() * axes.eigenvalues().cwiseMax(least).asDiagonal() * axes.eigenvectors().transpose();
  }
  return bounded;
}

}  // namespace sprung
