#pragma once
#include "core/law/material.h"
#include "core/law/neo_hooke/square_term.h"

namespace sprung {

/// What it costs to bend a brick: the edges along an axis i stretch differently on the two sides of an axis j,
///   b_ij = sum of |d|^2 / (2 h) of the edges along i, each times s_j (1/2 + s_k c_k), over h^2
/// with s = -1, +1 the sides and c the centroid in brick lengths. With m_jk the second moments of the solid about it,
///   W = 1/2 sum over gradients g, (i, k != g): m_gg E / (1 - nu^2) [[1, nu], [nu, 1]] (b_ig, b_kg)
///     + sum over i, (j, k != i): E m_jk b_ij b_ik                                 (bending about an inclined axis)
/// which is a beam's or a plate's E I curvature^2 / 2, wherever the surface cuts the brick.
/// `h`: m; `second`: m^5.
[[nodiscard]] SquareTerm<6> bending_term(const Material& material, double h, const Vec3& centroid, const Mat3& second);

/// The moments `second` with off-diagonal entries lowered, where W above would be negative for some bending: a thin rod
/// along a space diagonal, nu > 0.
[[nodiscard]] Mat3 stable_moments(const Material& material, const Mat3& second);

}  // namespace sprung
