#pragma once
#include <array>
#include <optional>
#include <vector>

#include "core/body/body.h"
#include "core/bricks/embedding.h"

namespace sprung {

/// The half-space y < height is solid.
struct Ground {
  double height = 0;       // m
  double friction = 0.5;   // Coulomb's coefficient
  double restitution = 0;  // of a single contact point; a soft body bounces by its own elasticity
};

/// A node that is held along some axes of the world: there it moves with the velocity given, whatever pulls at it.
struct HeldNode {
  int node = 0;
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();  // m/s
};

/// A body in the world with what touches on its behalf and what is held.
struct Actor {
  Body body;
  Embedding contacts;            // points of the skin, each position once
  std::vector<HeldNode> pinned;  // each node once; the ground cannot push them
};

struct World {
  std::vector<Actor> actors;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::optional<Ground> ground;
};

}  // namespace sprung
