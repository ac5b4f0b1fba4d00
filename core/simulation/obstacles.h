#pragma once
#include <vector>

#include "core/simulation/observer.h"
#include "core/simulation/scene.h"
#include "core/skin/skin.h"
#include "core/world/keyframes.h"
#include "core/world/obstacle.h"

namespace sprung {

/// An obstacle of the scene as it is drawn and moved.
struct StageObstacle {
  Shape shape;
  Pose start;         // before any keyframe
  Movement movement;  // about start.translation
  Skin skin;          // in the shape's frame; empty: level ground, or a plane with nothing to show
  Color color;
};

/// Makes the obstacles of a scene. `room` (m): half the side of what is drawn of a plane that is no level ground.
/// Throws Error(kBadInput) where a mesh does not enclose anything.
[[nodiscard]] std::vector<StageObstacle> make_obstacles(const Scene& scene, double room, const Observer& observer);

/// Where it is at a time of the film (s).
[[nodiscard]] Pose pose_at(const StageObstacle& obstacle, double time);

/// As a world has it: at `begin` (s) on its even way to where it is at `end`; at rest where both are the same.
[[nodiscard]] Obstacle obstacle_between(const StageObstacle& staged, const SceneObstacle& obstacle, double begin,
                                        double end);

}  // namespace sprung
