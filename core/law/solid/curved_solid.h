#pragma once
#include <Eigen/Core>

#include "core/bricks/solid_moments.h"
#include "core/types.h"

namespace sprung {

/// Bending and twist of the solid of a brick. Its strain varies linearly, in eighteen modes: its six components along
/// each of three axes. Nine of them follow from the corners (StrainDifferences: b, t), nine exist in no trilinear map
/// (strain ii along i; shear ij along i and along j): these minimise the energy, which gives a plate's Poisson effect
/// and a beam's curvature, along the axes of the brick or not. In
///   W = 1/2 sum over k, l: m_kl (strain along k) : C : (strain along l)
/// with Hooke's C and m the second moments of the solid about its centroid, they make
///   W = 1/2 E V h^2 z^T stiffness z,   z = (b, t).
/// Where the centroid is off the brick's middle they also bend the trilinear map: its gradient there, a secant, becomes
/// the tangent F (I + S), S = h tangent z. Without it bricks with a slanted thin part shear when they bend. Only shear
/// is corrected: the corners follow a change of thickness by themselves.
struct CurvedSolid {
  Eigen::Matrix<double, 9, 9> stiffness;  // positive semidefinite
  Eigen::Matrix<double, 3, 9> tangent;    // rows: S_12, S_20, S_01; S is symmetric, without a diagonal
};

/// S from such rows.
[[nodiscard]] Mat3 shear_matrix(const Vec3& rows);

/// `moments`: definite, in brick lengths.
[[nodiscard]] CurvedSolid curved_solid(double poisson, const SolidMoments& moments);

}  // namespace sprung
