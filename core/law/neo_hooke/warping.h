#pragma once
#include "core/law/material.h"
#include "core/law/neo_hooke/square_term.h"

namespace sprung {

/// What it costs to warp a brick: the edges along an axis i stretch by turns, u_i = x y z,
///   q_i = sum of |d|^2 / (2 h) of the edges along i, each times s_j s_k, over h^3
/// so that W = 1/2 sum over i: E m_jj m_kk / V q_i^2. `h`: m; `volume`: V, m^3; `second`: the solid's second moments
/// m, m^5.
[[nodiscard]] SquareTerm<3> warping_term(const Material& material, double h, double volume, const Mat3& second);

}  // namespace sprung
