#pragma once
#include "app/scene/film.h"
#include "core/simulation/recorder.h"
#include "render/stage/camera.h"

namespace sprung {

/// The extent that the cameras of a film must show: the bounds of the whole motion, and for each frame the extreme
/// points in 26 directions and the ground below them, where shadows fall.
struct Reach {
  AlignedBox bounds;
  std::vector<Points> bodies;  // by frame
  std::vector<Vec3> middles;   // by frame: centroid of the nodes
  Points around{0, 3};         // of obstacles near the bodies
  std::optional<double> ground;
  double lowest = 0;  // m, of the bodies
};

[[nodiscard]] Reach reach_of(const Simulation& simulation, const Recording& recording);

/// The extent within which bodies that fall onto the ground are expected to stay: known before they move, so that
/// pictures can be drawn while later frames are computed. `recording` needs its first frame and the times of all. None
/// for a film in which anything else moves the bodies, or whose camera moves or is placed without regard to their
/// height.
[[nodiscard]] std::optional<Reach> foreseen_reach(const Film& film, const Simulation& simulation,
                                                  const Recording& recording);

/// Returns whether bodies with these bounds are within the expected extent; those below the ground are not seen there.
[[nodiscard]] bool is_foreseen(const Reach& foreseen, const AlignedBox& bounds);

/// The union of one or more runs; those that end early stay in their last frame.
[[nodiscard]] Reach joined(const std::vector<Reach>& runs);

/// One camera per frame, from the direction that the scene states, which shows the whole motion (or, if it follows the
/// bodies, that frame) as large as possible, leaving free the fraction `reserved` of the picture's width at its right
/// edge.
[[nodiscard]] std::vector<Camera> cameras_of(const Film& film, const Reach& reach, double reserved);

/// Pixels per metre at the camera's target, in a picture of that height.
[[nodiscard]] double pixels_per_metre(const Camera& camera, int height);

}  // namespace sprung
