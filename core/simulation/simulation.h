#pragma once
#include <vector>

#include "core/bricks/embedding.h"
#include "core/bricks/thin_parts.h"
#include "core/simulation/body_source.h"
#include "core/simulation/obstacles.h"
#include "core/skin/skin.h"
#include "core/world/world.h"

namespace sprung {

/// A scene brought to bricks: what moves, what it meets, and what is seen of that.
struct Simulation {
  World world;
  std::vector<Skin> meshes;  // by body of the scene: its mesh with the vertices, order and triangles of the file, at
                             // rest; its own normals or none
  std::vector<StageObstacle> obstacles;  // of world.obstacles, and of the scene's
  double size = 0;                       // m, longest side of the largest body
};

/// Fills the bodies' solids with bricks, places them and finds what is held.
/// Throws Error(kBadInput) where a pin holds no node or a body starts more than a brick deep in an obstacle or in
/// another body.
[[nodiscard]] Simulation build_world(const Scene& scene, const std::vector<LoadedBody>& bodies,
                                     const Observer& observer);

/// Fills the solids of further bodies of the scene, from row `first` on, and adds them. Throws as build_world() does.
void add_bodies(const Scene& scene, std::size_t first, const std::vector<LoadedBody>& bodies, Simulation& simulation,
                const Observer& observer);

/// Lets the bodies' volume guards stand the impacts that gravity and speeds may bring; again where those have changed.
void stiffen_volume_guards(Simulation& simulation);

/// A scene ready to move, and what was found on the way.
struct Preparation {
  std::vector<LoadedBody> bodies;
  Simulation simulation;
  std::vector<std::vector<ThinPart>> thin_parts;  // by body of the world, in the frame of its grid
};

/// Reads the bodies of a scene and fills them with bricks; says what came out, and warns of what will not come out
/// well: what was repaired, what the bricks are too coarse for. Throws Error(kBadInput).
[[nodiscard]] Preparation prepare(const Scene& scene, const Observer& observer);

/// The simulation alone.
[[nodiscard]] Simulation prepare_simulation(const Scene& scene, const Observer& observer);

/// Glues two bodies of the scene, or the copies of one, together where their skins are near each other, as
/// Scene::glue[row] says. Throws Error(kBadInput) where they are near nowhere.
void glue_bodies(const Scene& scene, std::size_t row, Simulation& simulation);

/// A body may start a little too deep in what it touches, and is then lifted out gently; deeper it would be shot out.
/// Nodes that are held are in nobody's way.
/// Throws Error(kBadInput) naming the bodies or obstacles, how deep, and what to move.
void check_start(const Scene& scene, const Simulation& simulation);

}  // namespace sprung
