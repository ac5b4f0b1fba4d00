#include "app/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprung {

bool is_whole(const Selection& selection) {
  return !selection.box && !selection.sphere && !selection.half_space && selection.part.empty() && !selection.painted &&
         !selection.nearest && selection.mesh.empty();
}

int copy_count(const SceneBody& body) {
  return body.copies ? body.copies->count[0] * body.copies->count[1] * body.copies->count[2] : 1;
}

bool is_motion(const Scene& scene) {
  const Solver scheme = scene.solver.scheme;
  return scheme != Solver::kStatic && scheme != Solver::kLinear && scheme != Solver::kModes;
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

Look look_of(const SceneBody& body, const MaterialLibrary& library) {
  if (body.look) return *body.look;
  const LibraryMaterial* known = library.find_if_known(body.material.name);
  return known == nullptr ? Look::kPlastic : known->look;
}

Scene with_defaults(Scene scene) {
  for (SceneBody& body : scene.bodies) {
    if (!body.size && !body.scale && !body.mesh.empty()) body.size = kDefaultSize;
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks;
    if (built_in_materials()->find_if_known(body.material.name) == nullptr) body.look = look_of(body, *scene.library);
  }
  return scene;
}

}  // namespace sprung
