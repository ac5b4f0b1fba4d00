#pragma once
#include "core/body/membrane.h"
#include "core/dynamics/statics/statics.h"

namespace sprung {

/// Small displacements (m x 2, m) of a membrane under `loads` (m x 2, N): one linear solve at the positions it has.
/// Throws Error(kBadInput) where the supports leave the membrane free to move.
[[nodiscard]] Points2 solve_linear(const Membrane& membrane, const Points2& loads);

/// Moves the membrane into equilibrium under dead loads (m x 2, N): the minimum of elastic energy - loads . positions,
/// by Newton's method with a line search; the loads are applied in steps where one is not enough. Supported degrees of
/// freedom stay at membrane.positions. Throws Error(kDiverged) where no equilibrium is found.
StaticReport solve_static(Membrane& membrane, const Points2& loads, const StaticOptions& options = {});

/// Forces that the supports exert (m x 2, N); zero on free degrees of freedom.
[[nodiscard]] Points2 reactions(const Membrane& membrane, const Points2& loads);

}  // namespace sprung
