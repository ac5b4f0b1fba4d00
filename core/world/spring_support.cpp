#include "core/world/spring_support.h"

namespace sprung {

Vec3 stretch_of(const SpringSupport& support, const std::array<int, 8>& corners, const Points& displacements) {
  Vec3 moved = Vec3::Zero();
  for (int c = 0; c < 8; ++c) moved += support.spring.weights[c] * displacements.row(corners[c]).transpose();
  return support.displacement - moved;
}

Points support_forces(const std::vector<SpringSupport>& springs, const Body& body, const Points& displacements) {
  Points forces = Points::Zero(displacements.rows(), 3);
  for (const SpringSupport& support : springs) {
    const auto& nodes = body.grid.nodes[support.spring.brick];
    const Vec3 force = support.spring.stiffness * stretch_of(support, nodes, displacements);
    for (int c = 0; c < 8; ++c) forces.row(nodes[c]) += support.spring.weights[c] * force.transpose();
  }
  return forces;
}

double support_energy(const std::vector<SpringSupport>& springs, const Body& body, const Points& displacements) {
  double energy = 0;
  for (const SpringSupport& support : springs) {
    const Vec3 stretch = stretch_of(support, body.grid.nodes[support.spring.brick], displacements);
    energy += stretch.dot(support.spring.stiffness * stretch) / 2;
  }
  return energy;
}

}  // namespace sprung
