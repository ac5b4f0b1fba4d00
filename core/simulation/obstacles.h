#pragma once
#include <vector>

#include "core/simulation/observer.h"
#include "core/simulation/scene.h"
#include "core/skin/skin.h"
#include "core/world/keyframes.h"
#include "core/world/obstacle.h"

namespace sprung {

/// An obstacle of the scene with its skin and movement.
struct StageObstacle {
  Shape shape;
  Pose start;         // before any keyframe
  Movement movement;  // about start.translation
  Skin skin;          // in the shape's frame; empty for level ground and planes that are not drawn
  Color color;
};

/// Makes the obstacles of a scene. `room` (m): half the side of the drawn square of a plane other than level ground.
/// Throws Error(kBadInput) if a mesh does not enclose a volume.
[[nodiscard]] std::vector<StageObstacle> make_obstacles(const Scene& scene, double room, const Observer& observer);

/// Its pose at a time of the film (s).
[[nodiscard]] Pose pose_at(const StageObstacle& obstacle, double time);

/// Vertices of its skin at that time (s), m.
[[nodiscard]] Points skin_positions(const StageObstacle& obstacle, double time);

/// The obstacle of a world at `begin` (s), moving uniformly to its pose at `end`; at rest if both are equal.
[[nodiscard]] Obstacle obstacle_between(const StageObstacle& staged, const SceneObstacle& obstacle, double begin,
                                        double end);

}  // namespace sprung
