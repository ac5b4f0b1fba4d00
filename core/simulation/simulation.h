#pragma once
#include <vector>

#include "core/bricks/embedding.h"
#include "core/bricks/thin_parts.h"
#include "core/simulation/body_source.h"
#include "core/simulation/obstacles.h"
#include "core/simulation/origin.h"
#include "core/skin/skin.h"
#include "core/world/world.h"

namespace sprung {

/// A scene filled with bricks: its world, and what is drawn and exported of it.
struct Simulation {
  World world;
  std::vector<Origin> origins;  // by body of the world
  std::vector<Skin> meshes;     // by body of the scene: its mesh with the vertices, order and triangles of the file, at
                                // rest; its own normals or none
  std::vector<StageObstacle> obstacles;  // of world.obstacles, and of the scene's
  double size = 0;                       // m, longest side of the largest body
};

/// Fills the bodies' solids with bricks, places them and finds the pinned nodes. Throws Error(kBadInput) if a pin holds
/// no node or a body starts more than a brick deep in an obstacle or another body.
[[nodiscard]] Simulation build_world(const Scene& scene, const std::vector<LoadedBody>& bodies,
                                     const Observer& observer);

/// Fills the solids of further bodies of the scene, from row `first` on, and adds them. Throws as build_world() does.
void add_bodies(const Scene& scene, std::size_t first, const std::vector<LoadedBody>& bodies, Simulation& simulation,
                const Observer& observer);

/// A simulation ready to run, and what was found in preparing it.
struct Preparation {
  std::vector<LoadedBody> bodies;
  Simulation simulation;
  std::vector<std::vector<ThinPart>> thin_parts;  // by body of the world, in the frame of its grid
};

/// Reads the bodies of a scene and fills them with bricks; reports the result and warns of problems: repairs, and parts
/// for which the bricks are too coarse. Throws Error(kBadInput).
[[nodiscard]] Preparation prepare(const Scene& scene, const Observer& observer);

/// The simulation alone.
[[nodiscard]] Simulation prepare_simulation(const Scene& scene, const Observer& observer);

/// Glues two bodies of the scene, or the copies of one, where their skins are near each other, by Scene::glue[row].
/// Throws Error(kBadInput) if they are nowhere near.
void glue_bodies(const Scene& scene, std::size_t row, Simulation& simulation);

/// A small initial penetration is resolved gently; a deeper one would eject the body. Pinned nodes are ignored. Throws
/// Error(kBadInput) naming the bodies or obstacles, the depth, and what to move. A note tells of bodies that start
/// inside each other.
void check_start(const Scene& scene, const Simulation& simulation, const Observer& observer);

}  // namespace sprung
