#pragma once
#include "app/scene/film.h"
#include "core/simulation/recorder.h"
#include "render/camera.h"

namespace sprung {

/// What the cameras of a film have to see: the bounds of the whole motion, and for each frame the points that reach
/// furthest in 26 directions, with the ground below them, where shadows fall.
struct Reach {
  AlignedBox bounds;
  std::vector<Points> bodies;  // by frame
  std::vector<Vec3> middles;   // by frame: mean of the nodes
  Points around{0, 3};         // of obstacles near the bodies
  std::optional<double> ground;
  double lowest = 0;  // m, of the bodies
};

[[nodiscard]] Reach reach_of(const Simulation& simulation, const Recording& recording);

/// Of several runs at once; those that end early stay where they are. At least one.
[[nodiscard]] Reach joined(const std::vector<Reach>& runs);

/// One camera a frame: from where the scene says, seeing the whole motion (or, where it follows the bodies, each frame)
/// as large as possible, in the part of the picture's width that is left beside `reserved` at the right.
[[nodiscard]] std::vector<Camera> cameras_of(const Film& scene, const Reach& reach, double reserved);

/// Pixels that a metre has at the point that the camera looks at, in a picture of that height.
[[nodiscard]] double pixels_per_metre(const Camera& camera, int height);

}  // namespace sprung
