#include "core/world/world.h"

namespace sprung {

Points SoftBody::skin_positions(const Points& nodes) const { return deform_points(grid, drawn.embedding, nodes); }

std::vector<SpringSupport> SoftBody::supports_after(double time) const {
  std::vector<SpringSupport> all;
  for (const std::vector<SpringSupport>& springs : foundations) all.insert(all.end(), springs.begin(), springs.end());
  for (SpringSupport& support : all) support.displacement += time * support.velocity;
  return all;
}

void move_prescribed(World& world, double time) {
  move_obstacles(world.obstacles, time);
  for (SoftBody& body : world.bodies) {
    for (std::vector<SpringSupport>& springs : body.foundations) {
      for (SpringSupport& support : springs) support.displacement += time * support.velocity;
    }
  }
}

}  // namespace sprung
