#include "core/law/neo_hooke/solid_brick.h"

#include <Eigen/Eigenvalues>

namespace sprung {

SolidMoments bounded_moments(const Material& material, const SolidMoments& moments, double least_thickness) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments.covariance);
  const double least = least_thickness * least_thickness / 12;
  SolidMoments bounded = moments;
  if (axes.eigenvalues()[0] < least) {
    bounded.covariance =
        axes.eigenvectors() * axes.eigenvalues().cwiseMax(least).asDiagonal() * axes.eigenvectors().transpose();
  }
  bounded.covariance = stable_moments(material, bounded.covariance);
  return bounded;
}

}  // namespace sprung
