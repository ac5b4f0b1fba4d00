#pragma once
#include <Eigen/Core>

#include "core/body/body.h"
#include "core/body/brick_kernel.h"
#include "core/law/brick_vector.h"

namespace sprung {

/// Second derivative of the energy of one full brick of side h with corners at x: 24 x 24, N/m, symmetric, guard
/// included. Away from rest it may have negative eigenvalues.
[[nodiscard]] BrickMatrix brick_hessian(const BrickLaw& law, double h, const CornerVectors<double>& x);

/// The Hessian of one brick of a body at its current positions, by its model. `definite`: see BrickModel::hessian().
[[nodiscard]] BrickMatrix body_brick_hessian(const Body& body, std::size_t brick, bool definite = false);

/// The same matrix with its negative eigenvalues set to zero, so that Newton's direction is a descent direction.
[[nodiscard]] BrickMatrix without_negative_curvature(const BrickMatrix& hessian);

/// The largest eigenvalue (N/m) of a full brick's stiffness at rest, guard left out. Divided by the mass of a corner,
/// it is the square of the fastest frequency any body of such bricks can have.
[[nodiscard]] double largest_brick_stiffness(const Body& body);

}  // namespace sprung
