#pragma once
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

/// A body in the world with what touches on its behalf and what is held.
struct Actor {
  Body body;
  Embedding contacts;       // points of the skin, each position once
  std::vector<int> pinned;  // nodes held where they are
};

struct World {
  std::vector<Actor> actors;
  Vec3 gravity{0, -9.81, 0};  // m/s^2
  std::optional<Ground> ground;
};

}  // namespace sprung
