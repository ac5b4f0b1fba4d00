#pragma once
#include <vector>

#include "app/build_world.h"
#include "app/selector.h"

namespace sprung {

/// Where the forces of a body of the scene act on one of its solids, which is still where its grid is: those that act
/// there at all. Throws Error(kBadInput) where a part speaks of what is not there.
[[nodiscard]] std::vector<ForcedPart> place_forces(const std::vector<BodyForce>& forces, const Selector& selector,
                                                   const Actor& actor, std::size_t solid);

/// The same of its muscles. `bricks_from_rest`: how the body was turned so that its bricks are straight.
[[nodiscard]] std::vector<MusclePart> place_muscles(const std::vector<BodyMuscle>& muscles, const Selector& selector,
                                                    const Actor& actor, std::size_t solid,
                                                    const Mat3& bricks_from_rest);

/// Throws Error(kBadInput) where a force or a muscle of a body of the scene acts on none of its actors.
void check_loads(const Scene& scene, std::size_t body, const std::vector<Origin>& origins);

}  // namespace sprung
