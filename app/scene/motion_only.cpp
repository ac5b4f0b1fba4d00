#include "app/scene/motion_only.h"

#include <algorithm>

namespace sprung {

std::vector<MotionOnly> motion_only(const Scene& scene) {
  std::vector<MotionOnly> parts;
  if (!scene.glue.empty()) parts.push_back({.key = "glue", .what = "glue"});
  if (scene.wind) parts.push_back({.key = "wind", .what = "a wind"});
  const auto is_steady = [&](const BodyForce& force) {
    return scene.solver.scheme != Solver::kModes && !force.pressure && force.keyframes.empty();
  };
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (!scene.bodies[row].muscles.empty()) parts.push_back({.key = "body", .row = row, .what = "a muscle"});
    const std::vector<BodyForce>& forces = scene.bodies[row].forces;
    if (std::all_of(forces.begin(), forces.end(), is_steady)) continue;
    parts.push_back(
        {.key = "body", .row = row, .what = "a pressure or a force with keyframes; and modes have no forces at all"});
  }
  if (!scene.gravity_keyframes.empty()) parts.push_back({.key = "gravity_keyframes", .what = "gravity_keyframes"});
  return parts;
}

}  // namespace sprung
