#pragma once
#include <string>

#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Throws Error(kBadInput) that names the softest motion which the supports leave a body at the positions it has:
/// where, how many nodes, and whether they slide or turn. `doing`: what was to be done, "found no equilibrium". Returns
/// where the body resists all motions.
void throw_if_free(const Body& body, const Supports& supports, const std::string& doing);

}  // namespace sprung
