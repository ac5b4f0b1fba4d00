#include "app/scene/motion_only.h"

#include <algorithm>

namespace sprung {

std::vector<MotionOnly> explicit_only(const Scene& scene) {
  std::vector<MotionOnly> parts;
  if (scene.wind) parts.push_back({.key = "wind", .what = "a wind"});
  if (!scene.glue.empty()) parts.push_back({.key = "glue", .what = "glue"});
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (!scene.bodies[row].muscles.empty()) parts.push_back({.key = "body", .row = row, .what = "a muscle"});
    if (!scene.bodies[row].forces.empty()) parts.push_back({.key = "body", .row = row, .what = "a force"});
  }
  return parts;
}

std::vector<MotionOnly> motion_only(const Scene& scene) {
  std::vector<MotionOnly> parts = explicit_only(scene);
  const auto is_steady = [&](const MotionOnly& part) {
    if (part.what != "a force" || scene.solver.scheme == Solver::kModes) return false;
    const std::vector<BodyForce>& forces = scene.bodies[part.row].forces;
    return std::all_of(forces.begin(), forces.end(),
                       [](const BodyForce& force) { return !force.pressure && force.keyframes.empty(); });
  };
  std::erase_if(parts, is_steady);
  for (MotionOnly& part : parts) {
    if (part.what == "a force") part.what = "a pressure or a force with keyframes; and modes have no forces at all";
  }
  if (!scene.gravity_keyframes.empty()) parts.push_back({.key = "gravity_keyframes", .what = "gravity_keyframes"});
  return parts;
}

}  // namespace sprung
