#pragma once
#include "core/body/body.h"

namespace sprung {

/// Measures of the deformation gradient F of a brick (BrickModel::gradient()). E = (F^T F - 1) / 2, J = det F.
enum class BrickMeasure {
  kStretch,  // largest principal stretch: greatest length over length at rest
  kStrain,   // von Mises: sqrt(2/3 dev E : dev E)
  kStress,   // von Mises: sqrt(3/2 dev s : dev s), Pa, of s = F S F^T / J, S = BrickModel::second_stress()
  kVolume    // J: volume over volume at rest
};

/// Which strain is measured.
enum class StrainMeasure {
  kFinite,  // Green's, see above
  kSmall    // to first order in the displacements, with the stress by Hooke's law: for linear statics
};

/// lambda tr(strain) + 2 mu strain, Pa.
[[nodiscard]] Mat3 hooke_stress(const Mat3& strain, double young, double poisson);
/// F s F^T / J, J at least 0.05: from the second Piola-Kirchhoff stress s.
[[nodiscard]] Mat3 cauchy_stress(const Mat3& gradient, const Mat3& second);
/// sqrt(3/2 dev s : dev s).
[[nodiscard]] double von_mises(const Mat3& stress);

/// One number per brick for these positions of the body's nodes (m x 3, m). kStress includes the stiffness of the
/// brick's region and takes J as at least 0.05. Small strains change kStrain, kStress and kVolume (1 + tr E).
/// Deterministic for any number of threads.
[[nodiscard]] Eigen::VectorXd measure_bricks(const Body& body, BrickMeasure measure, const Points& positions,
                                             StrainMeasure strain = StrainMeasure::kFinite);

/// One number per node: the mean of its bricks, weighted by their fill.
[[nodiscard]] Eigen::VectorXd node_means(const BrickGrid& grid, const Eigen::VectorXd& of_bricks);

/// Young's modulus of each brick, Pa.
[[nodiscard]] Eigen::VectorXd brick_youngs(const Body& body);

}  // namespace sprung
