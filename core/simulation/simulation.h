#pragma once
#include <vector>

#include "core/bricks/embedding.h"
#include "core/bricks/thin_parts.h"
#include "core/simulation/body_source.h"
#include "core/simulation/obstacles.h"
#include "core/skin/skin.h"
#include "core/world/world.h"

namespace sprung {

/// The skin of one actor and how it rides on its bricks.
struct DrawnSkin {
  Skin skin;
  Embedding embedding;
  Color color;
};

/// The nodes of one actor that a pin of the scene holds.
struct PinnedNodes {
  std::size_t pin = 0;  // row in SceneBody::pins
  std::vector<int> nodes;
  Vec3 centre = Vec3::Zero();  // m, in the world: what the pin turns about
};

/// Where a force of the scene acts on one actor.
struct ForcedPart {
  std::size_t force = 0;       // row in SceneBody::forces
  Eigen::VectorXd volumes;     // per node, m^3: its share of the bricks of the part
  std::vector<int> triangles;  // of a pressure: rows of Actor::contact_triangles
};

/// Which bricks of one actor a muscle of the scene is made of.
struct MusclePart {
  std::size_t muscle = 0;  // row in SceneBody::muscles
  Muscle full;             // at full strength
};

/// The vertices of a body's mesh, as its file has them, that ride on one actor.
struct CarriedVertices {
  std::vector<int> vertices;  // rows of Production::meshes[body]
  Embedding embedding;
};

/// Which body of the scene an actor is made from, and how it was placed.
struct Origin {
  std::size_t body = 0;  // row in Scene::bodies
  int copy = 0;          // of the body, which one
  Mat3 bricks_from_rest = Mat3::Identity();
  std::vector<int> regions;       // per brick: row in SceneBody::regions, counted from 1; 0: of the body's own material
  std::vector<PinnedNodes> pins;  // those that hold any node of this actor
  std::vector<ForcedPart> forces;
  std::vector<MusclePart> muscles;
};

/// All nodes that pins hold, ascending, each once.
[[nodiscard]] std::vector<int> pinned_nodes(const Origin& origin);

/// What moves and what is seen of it: skins[i], carried[i] and origins[i] belong to world.actors[i].
struct Production {
  World world;
  std::vector<DrawnSkin> skins;
  std::vector<CarriedVertices> carried;
  std::vector<Skin> meshes;  // by body of the scene: its mesh with the vertices, order and triangles of the file, at
                             // rest; its own normals or none
  std::vector<Origin> origins;
  std::vector<StageObstacle> obstacles;  // of world.obstacles, and of the scene's
  double size = 0;                       // m, longest side of the largest body
};

/// Fills the bodies' solids with bricks, places them and finds what is held.
/// Throws Error(kBadInput) where a pin holds no node or a body starts more than a brick deep in an obstacle or in
/// another body.
[[nodiscard]] Production build_world(const Scene& scene, const std::vector<LoadedBody>& bodies,
                                     const Observer& observer);

/// Skin vertices of actor i for these positions of its nodes, m.
[[nodiscard]] Points skin_positions(const Production& production, std::size_t actor, const Points& nodes);

/// A scene ready to move, and what was found on the way.
struct Preparation {
  std::vector<LoadedBody> bodies;
  Production production;
  std::vector<std::vector<ThinPart>> thin_parts;  // by actor, in the frame of its grid
};

/// Reads the bodies of a scene and fills them with bricks; says what came out, and warns of what will not come out
/// well: what was repaired, what the bricks are too coarse for. Throws Error(kBadInput).
[[nodiscard]] Preparation prepare(const Scene& scene, const Observer& observer);

/// The production alone.
[[nodiscard]] Production make_production(const Scene& scene, const Observer& observer);

/// Glues two bodies of the scene, or the copies of one, together where their skins are near each other, as
/// Scene::glue[row] says. Throws Error(kBadInput) where they are near nowhere.
void glue_bodies(const Scene& scene, std::size_t row, Production& production);

/// A body may start a little too deep in what it touches, and is then lifted out gently; deeper it would be shot out.
/// Nodes that are held are in nobody's way.
/// Throws Error(kBadInput) naming the bodies or obstacles, how deep, and what to move.
void check_start(const Scene& scene, const Production& production);

}  // namespace sprung
