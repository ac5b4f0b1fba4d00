#pragma once
#include <Eigen/Core>

#include "core/law/material.h"

namespace sprung {

/// Stress by strain, both as three normal and three shear components with engineering shears, Pa.
[[nodiscard]] Eigen::Matrix<double, 6, 6> elasticity(const Material& material);

/// Stiffness (24 x 24, N/m, corner by corner, x y z) of the classical trilinear hexahedron on a cube of side h: small
/// strains, isotropic elasticity, 2 x 2 x 2 Gauss points. What most finite-element programs would use on the same
/// grid; a model to compare with, not to animate with, since it does not follow rotations.
/// Source: Zienkiewicz, Taylor, Zhu, "The Finite Element Method: Its Basis and Fundamentals", section on brick
/// elements.
[[nodiscard]] Eigen::Matrix<double, 24, 24> hexahedron_stiffness(const Material& material, double h);

}  // namespace sprung
