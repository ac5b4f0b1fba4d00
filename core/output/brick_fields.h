#pragma once
#include "core/body/body.h"

namespace sprung {

/// What the bricks of a body feel, one number each, from their mean axes: F has them over h as its columns, and
/// F^T F = U^2.
struct BrickFields {
  Eigen::VectorXf stretch;  // largest principal strain, of U - I
  Eigen::VectorXf stress;   // Pa, von Mises': sqrt(3/2) 2 mu |dev(U - I)| with the brick's own shear modulus mu
};
/// `positions` of the nodes, m x 3, m.
[[nodiscard]] BrickFields brick_fields(const Body& body, const Points& positions);

/// Young's modulus of each brick's material, Pa.
[[nodiscard]] Eigen::VectorXf brick_moduli(const Body& body);

}  // namespace sprung
