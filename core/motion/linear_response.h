#pragma once
#include "core/motion/newton_system.h"

namespace sprung {

/// How a body answers small loads and small movements of its supports, at the positions it has.
struct LinearResponse {
  Points displacements;  // m x 3, m
  Points reactions;      // m x 3, N: of the supports, zero on free degrees of freedom
};

/// Solves K u = loads (m x 3, N) with u = `movements` (m x 3, m) where it is supported; the other entries of
/// `movements` are ignored. Throws Error(kBadInput) where the supports leave the body free to move.
[[nodiscard]] LinearResponse linear_response(const Body& body, const Supports& supports, const Points& loads,
                                             const Points& movements, NewtonSystem& system);

}  // namespace sprung
