#include "app/scene/make_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/scenarios.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"

namespace sprung {
namespace {

bool is_of_materials(const Setting& setting) { return setting.key == "materials"; }

/// What can be named: also in a scene file that does not say where it comes from.
std::shared_ptr<const MaterialLibrary> library_of(const std::vector<Setting>& settings) {
  if (std::none_of(settings.begin(), settings.end(), is_of_materials)) return built_in_materials();
  auto library = std::make_shared<MaterialLibrary>(*built_in_materials());
  for (const Setting& setting : settings) {
    if (is_of_materials(setting)) library->add_file(setting.value);
  }
  return library;
}

Film bare_mesh(const std::filesystem::path& mesh, const std::shared_ptr<const MaterialLibrary>& library) {
  Film scene;
  scene.library = library;
  scene.bodies.emplace_back(default_body()).mesh = std::filesystem::absolute(mesh).lexically_normal();
  return scene;
}

/// m.
double height_of(const SceneBody& body) {
  const Points points = read_mesh(body.mesh).positions;
  const Vec3 extent = points.colwise().maxCoeff() - points.colwise().minCoeff();
  const double scale = body.scale.value_or(body.size.value_or(kDefaultSize) / extent.maxCoeff());
  return scale * extent.y();
}

void apply(const Setting& setting, Film& scene) {
  try {
    set_scene_key(scene, setting.key, setting.value);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", setting.option, error.what()));
  }
}

}  // namespace

Film make_scene(const SceneOptions& options) {
  const bool is_scene = is_scene_file(options.input);
  if (is_scene && options.scenario) {
    throw Error(ErrorKind::kUsage, "--scenario is for a bare mesh; a scene file says itself what happens");
  }
  const auto library = library_of(options.settings);
  Film scene = is_scene ? read_scene(options.input, *library) : bare_mesh(options.input, library);
  for (const Setting& setting : options.settings) {
    if (!is_of_materials(setting)) apply(setting, scene);
  }
  if (is_scene) return scene;
  const Scenario scenario = options.scenario.value_or(Scenario::kDrop);
  stage_scenario(scene, scenario, needs_height(scenario) ? height_of(scene.bodies[0]) : 0);
  return scene;
}

}  // namespace sprung
