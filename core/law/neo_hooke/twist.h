#pragma once
#include "core/law/material.h"
#include "core/law/neo_hooke/square_term.h"

namespace sprung {

/// What it costs to twist a brick: the two faces across an axis k are sheared differently,
///   t_k = (g of the high face - g of the low face) / h,   g = (|one diagonal|^2 - |the other|^2) / (4 h^2)
/// so that W = 1/2 sum over k: G m_kk t_k^2. `h`: m; `second`: the second moments m of the solid, m^5.
[[nodiscard]] SquareTerm<3> twist_term(const Material& material, double h, const Mat3& second);

}  // namespace sprung
