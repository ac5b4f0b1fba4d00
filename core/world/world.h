#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/body/body.h"
#include "core/bricks/embedding.h"
#include "core/world/loads.h"
#include "core/world/obstacle.h"

namespace sprung {

struct ContactSurface;

/// A node that is held along some axes of the world: there it moves with the velocity given, whatever pulls at it.
struct KinematicNode {
  int node = 0;
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();  // m/s
};

/// A body in the world with what touches on its behalf and what is held.
struct Actor {
  Body body;
  Embedding contacts;                 // points of the skin, each position once
  std::vector<KinematicNode> pinned;  // each node once; nothing it touches can push it
  Triangles contact_triangles{};      // rows of contacts; none: it touches obstacles only
  double friction = 0.5;              // on another body: the geometric mean of both
  bool collides_with_itself = true;   // not for what overlaps itself at rest
  Loads loads{};
  std::shared_ptr<const ContactSurface>
      contact_skin{};  // of the contacts as they are first used; see contact_surface_of()
};

struct World {
  std::vector<Actor> actors;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::vector<Obstacle> obstacles;
  bool bodies_collide = true;  // each other
  Wind wind{};
  std::vector<GluedPoint> glue{};
};

}  // namespace sprung
