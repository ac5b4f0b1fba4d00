#pragma once
#include <array>
#include <vector>

#include "core/body/body.h"
#include "core/world/point_stiffness.h"

namespace sprung {

/// A spring that pulls a point of a body towards a displaced position.
struct SpringSupport {
  PointStiffness spring;
  Vec3 displacement = Vec3::Zero();  // m, from rest
  Vec3 velocity = Vec3::Zero();      // m/s, of that position
};

/// From the spring's point to the position that it is pulled to, m. `displacements`: from rest (m), in the rows
/// `corners` those of its brick's corners.
[[nodiscard]] Vec3 stretch_of(const SpringSupport& support, const std::array<int, 8>& corners,
                              const Points& displacements);

/// The springs' forces on the nodes (m x 3, N) and their energy (J), with nodes displaced from rest (m x 3, m).
[[nodiscard]] Points support_forces(const std::vector<SpringSupport>& springs, const Body& body,
                                    const Points& displacements);
[[nodiscard]] double support_energy(const std::vector<SpringSupport>& springs, const Body& body,
                                    const Points& displacements);

}  // namespace sprung
