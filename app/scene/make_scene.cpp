#include "app/scene/make_scene.h"

#include <fmt/format.h>

#include "app/scene/scenarios.h"
#include "app/scene/scene_file.h"
#include "core/error.h"

namespace sprung {
namespace {

Scene bare_mesh(const std::filesystem::path& mesh) {
  Scene scene;
  scene.bodies.emplace_back().mesh = std::filesystem::absolute(mesh).lexically_normal();
  return scene;
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
  if (!is_scene) stage_scenario(scene, options.scenario.value_or(Scenario::kDrop));
  return scene;
}

}  // namespace sprung
