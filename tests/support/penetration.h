#pragma once
#include <algorithm>

#include "core/contact/penetration.h"
#include "core/simulation/observer.h"
#include "core/world/world.h"

namespace sprung::test {

/// How deep (m) any contact point is in an obstacle, or in another body if bodies are in contact.
inline double deepest_contact_point(const World& world) {
  double depth = 0;
  for (const SoftBody& body : world.bodies) {
    for (const Obstacle& obstacle : world.obstacles) depth = std::max(depth, penetration_depth(obstacle, body));
    for (const SoftBody& other : world.bodies) {
      const bool may_touch = world.bodies_collide && &other != &body;
      if (!may_touch || !bounding_box(other.positions).intersects(bounding_box(body.positions))) continue;
      depth = std::max(depth, penetration_depth(other, body));
    }
  }
  return depth;
}

/// Records that over all frames of a run.
class PenetrationObserver : public Observer {
 public:
  void finish_frame(int frame, double, const World& world) const override {
    if (frame > 0) deepest_ = std::max(deepest_, deepest_contact_point(world));
  }
  [[nodiscard]] double deepest() const { return deepest_; }

 private:
  mutable double deepest_ = 0;  // m
};

}  // namespace sprung::test
