#include "core/simulation/scene.h"

#include <algorithm>
#include <cmath>

namespace sprung {

bool is_whole(const Selection& selection) {
  return !selection.box && !selection.sphere && !selection.half_space && selection.part.empty() && !selection.painted &&
         !selection.face && !selection.nearest && selection.mesh.empty();
}

int copy_count(const SceneBody& body) {
  return body.copies ? body.copies->count[0] * body.copies->count[1] * body.copies->count[2] : 1;
}

bool is_motion(const Scene& scene) {
  const Solver scheme = scene.solver.scheme;
  return scheme != Solver::kStatic && scheme != Solver::kLinear && scheme != Solver::kModes;
}

Material simulated_material(const Scene& scene, const SceneBody& body) {
  return is_motion(scene) ? body.material.in_motion() : body.material;
}

StrainMeasure strain_measure(const Scene& scene) {
  const Solver scheme = scene.solver.scheme;
  return scheme == Solver::kLinear || scheme == Solver::kModes ? StrainMeasure::kSmall : StrainMeasure::kFinite;
}

int frame_count(const Scene& scene) {
  const bool has_loads = scene.solver.scheme == Solver::kStatic || scene.solver.scheme == Solver::kLinear;
  if (has_loads && scene.solver.load_steps) return *scene.solver.load_steps + 1;
  return std::max(1, int(std::lround(scene.duration * scene.fps)));
}

double time_of(const Scene& scene, int frame) {
  if (is_motion(scene)) return frame / scene.fps;
  const int last = frame_count(scene) - 1;
  return last == 0 ? scene.duration : scene.duration * frame / last;
}

std::vector<MotionOnly> motion_only(const Scene& scene) {
  std::vector<MotionOnly> parts;
  if (!scene.glue.empty()) parts.push_back({.key = "glue", .what = "glue"});
  if (scene.wind) parts.push_back({.key = "wind", .what = "a wind"});
  const auto is_steady = [&](const BodyForce& force) {
    return scene.solver.scheme != Solver::kModes && force.keyframes.empty();
  };
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (!scene.bodies[row].muscles.empty()) parts.push_back({.key = "body", .row = row, .what = "a muscle"});
    const std::vector<BodyForce>& forces = scene.bodies[row].forces;
    if (std::all_of(forces.begin(), forces.end(), is_steady)) continue;
    parts.push_back({.key = "body", .row = row, .what = "a force with keyframes; and modes have no forces at all"});
  }
  if (!scene.gravity_keyframes.empty()) parts.push_back({.key = "gravity_keyframes", .what = "gravity_keyframes"});
  return parts;
}

}  // namespace sprung
