#include "app/scene/make_scene.h"

#include <fmt/format.h>

#include "app/scene/scenarios.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/mesh/read_mesh.h"

namespace sprung {
namespace {

Scene bare_mesh(const std::filesystem::path& mesh) {
  Scene scene;
  scene.bodies.emplace_back().mesh = std::filesystem::absolute(mesh).lexically_normal();
  return scene;
}

/// m.
double height_of(const SceneBody& body) {
  const Points points = read_mesh(body.mesh).positions;
  const Vec3 extent = points.colwise().maxCoeff() - points.colwise().minCoeff();
  const double scale = body.scale.value_or(body.size.value_or(kDefaultSize) / extent.maxCoeff());
  return scale * extent.y();
}

void apply(const Setting& setting, Scene& scene) {
  try {
    set_scene_key(scene, setting.key, setting.value);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", setting.option, error.what()));
  }
}

}  // namespace

Scene make_scene(const SceneOptions& options) {
  const bool is_scene = is_scene_file(options.input);
  if (is_scene && options.scenario) {
    throw Error(ErrorKind::kUsage, "--scenario is for a bare mesh; a scene file says itself what happens");
  }
  Scene scene = is_scene ? read_scene(options.input) : bare_mesh(options.input);
  for (const Setting& setting : options.settings) apply(setting, scene);
  if (is_scene) return scene;
  const Scenario scenario = options.scenario.value_or(Scenario::kDrop);
  stage_scenario(scene, scenario, needs_height(scenario) ? height_of(scene.bodies[0]) : 0);
  return scene;
}

}  // namespace sprung
