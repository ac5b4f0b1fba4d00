#pragma once
#include <vector>

#include "app/build_world.h"

namespace sprung {

/// Where every node is in every frame: frames[frame][actor], nodes x 3, m. Single precision: the picture needs no more.
struct Recording {
  std::vector<std::vector<Floats3>> frames;
};

/// Moves the world through the scene, frame 0 at t = 0. Says how far it is and what came out.
/// Throws Error(kDiverged), Interrupted.
[[nodiscard]] Recording simulate(World& world, const Scene& scene, const Console& console);

}  // namespace sprung
