#pragma once
#include <vector>

#include "core/simulation/selector.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Where the forces of a scene body act on one of its solids, which is still at the position of its grid; forces that
/// do not act on it are left out. Throws Error(kBadInput) if a part does not exist.
[[nodiscard]] std::vector<ForcedPart> place_forces(const std::vector<BodyForce>& forces, const Selector& selector,
                                                   const SoftBody& body, std::size_t solid);

/// The same for its muscles. `bricks_from_rest`: see LoadedBody.
[[nodiscard]] std::vector<MusclePart> place_muscles(const std::vector<BodyMuscle>& muscles, const Selector& selector,
                                                    const SoftBody& body, std::size_t solid,
                                                    const Mat3& bricks_from_rest);

/// Rotates (then translates) where a force acts.
void place(ForcedPart& part, const Mat3& rotation, const Vec3& translation);

/// Throws Error(kBadInput) if a force or a muscle of a body of the scene acts on none of its bodies.
void check_loads(const Scene& scene, std::size_t body, const std::vector<Origin>& origins);

/// The volume that a force is spread over: all solids of one copy of a body.
struct ForcedWhole {
  double size = 0;             // m^3 or m^2
  Vec3 arm = Vec3::Zero();     // of a moment, m^3
  Mat3 second = Mat3::Zero();  // of a moment, m^4
};

/// These volumes by body of the world, and by force of its scene body.
[[nodiscard]] std::vector<std::vector<ForcedWhole>> forced_wholes(const Scene& scene,
                                                                  const std::vector<Origin>& origins);

/// The loads at full strength on a body of the world and its weight, as forces, its muscles left out. `wholes`: of this
/// body.
[[nodiscard]] Loads loads_and_weight(const Scene& scene, const Simulation& simulation, std::size_t body,
                                     const std::vector<ForcedWhole>& wholes);

/// Adds one of them, times a strength.
void add_load(const BodyForce& force, const ForcedPart& part, const ForcedWhole& whole, double strength, Loads& loads);

}  // namespace sprung
