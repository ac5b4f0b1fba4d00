#pragma once
#include <string>

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Throws Error(kBadInput) naming the softest motion that the supports leave a body at its current positions: where,
/// how many nodes, and whether they slide or turn. `doing`: the failed task, "found no equilibrium". Returns if the
/// body resists all motions.
void throw_if_free(const Body& body, const Supports& supports, const std::string& doing);

}  // namespace sprung
