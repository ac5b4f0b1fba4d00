#pragma once
#include "core/body/body.h"
#include "core/body/corner_sums.h"
#include "core/body/spring_system.h"

namespace sprung {

/// Room for the forces of one body, kept between steps.
struct ForceWorkspace {
  SpringSystem springs;
  CornerSums hexahedra;  // Model::kFem only
};

/// Forces of all springs on the nodes, m x 3, N: elastic, guard, and beta damping (at body.velocities), without gravity
/// and alpha damping. The same bits for any number of threads.
void spring_forces(const Body& body, ForceWorkspace& workspace, Points& forces);

/// Elastic energy stored in the springs, J, guard included.
[[nodiscard]] double elastic_energy(const Body& body, ForceWorkspace& workspace);
[[nodiscard]] double elastic_energy(const Body& body);

/// Sum of the sizes of what every brick pulls at its corners, component by component, N.
[[nodiscard]] double corner_force_sum(const Body& body);

/// 1/2 sum m v^2, J.
[[nodiscard]] double kinetic_energy(const Body& body);

/// Of the fastest node, m/s.
[[nodiscard]] double largest_speed(const Body& body);

/// Sum of m v, kg m/s, and sum of x cross m v about the world's origin, kg m^2/s.
[[nodiscard]] Vec3 linear_momentum(const Body& body);
[[nodiscard]] Vec3 angular_momentum(const Body& body);

}  // namespace sprung
