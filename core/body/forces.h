#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/body/brick_block.h"

namespace sprung {

/// Room for the forces of every brick on its corners before they are summed node by node; kept between steps.
struct ForceWorkspace {
  std::vector<double> corner_forces;  // 24 a brick
  std::vector<double> energies;       // a brick, J
};

/// Forces of all springs on the nodes, m x 3, N: elastic, guard, and beta damping (at body.velocities), without gravity
/// and alpha damping. Bricks are computed in parallel and summed in a fixed order: the same bits for any number of
/// threads.
void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces);

/// The arrays of a body that the innermost loop reads; they must outlive it.
[[nodiscard]] BlockInput block_input(const Body& body);

/// Elastic energy stored in the springs, J, guard included.
[[nodiscard]] double elastic_energy(const Body& body);

/// 1/2 sum m v^2, J.
[[nodiscard]] double kinetic_energy(const Body& body);

/// Sum of m v, kg m/s, and sum of x cross m v about the world's origin, kg m^2/s.
[[nodiscard]] Vec3 linear_momentum(const Body& body);
[[nodiscard]] Vec3 angular_momentum(const Body& body);

}  // namespace sprung
