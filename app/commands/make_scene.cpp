#include "app/commands/make_scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/resting_pose.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"
#include "app/scene/supporting_material.h"
#include "core/error.h"
#include "core/files.h"
#include "core/mesh/io/read_mesh.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr double kShortestDrop = 2;  // s; between these it ends once it has come to rest
constexpr double kLongestDrop = 4;
constexpr double kRoundRise = 0.005;   // sizes: what tips over by so small a rise of its centre of mass is round, ...
constexpr double kRoundDrop = 0.03;    // ... may roll, and falls from here
constexpr double kWorthTelling = 0.2;  // rad, of a rotation

bool is_of_materials(const Setting& setting) { return setting.key == "materials"; }

bool is_given(const SceneRequest& request, std::string_view key) {
  return std::any_of(request.settings.begin(), request.settings.end(),
                     [&](const Setting& setting) { return setting.key == key; });
}

/// The materials known by name, also in a scene file that names no file of materials itself.
std::shared_ptr<const MaterialLibrary> library_of(const SceneRequest& request) {
  std::vector<Setting> settings = request.defaults;
  settings.insert(settings.end(), request.settings.begin(), request.settings.end());
  if (std::none_of(settings.begin(), settings.end(), is_of_materials)) return built_in_materials();
  auto library = std::make_shared<MaterialLibrary>(*built_in_materials());
  for (const Setting& setting : settings) {
    if (is_of_materials(setting)) library->add_file(setting.value);
  }
  return library;
}

/// Tells what curves gave the materials of bodies.
void tell_fits(const Film& film, const Observer& observer) {
  for (std::size_t i = 0; i < film.bodies.size(); ++i) {
    const Material& material = film.bodies[i].material;
    if (material.name != "custom" || material.source.empty()) continue;
    observer.note(fmt::format("material of body {}: E = {}, law {}; {}", i + 1,
                              readable(material.young, Dimension::kPressure), law_text(material.law), material.source));
  }
}

/// Sets the softest material that supports the body of a bare mesh, its size if even the stiffest does not, and the
/// faster time stepping for it.
void choose_material(Film& film, const SceneRequest& request, Scenario scenario, const Observer& observer) {
  SceneBody& body = film.bodies[0];
  const bool is_sized = body.size || body.scale;
  const Support support = scenario == Scenario::kHang ? Support::kHangs : Support::kStands;
  const std::optional<SupportingMaterial> found =
      softest_supporting(body, support, film.gravity, !is_sized, *film.library, observer);
  if (!found) {
    body.material.name = kDefaultMaterial;
    observer.warn(fmt::format("material: no elastomer of the library carries {}; it stays {}",
                              body.mesh.filename().string(), body.material.name));
    return;
  }
  body.material = found->material->material();
  const bool is_smaller = !is_sized && found->size < 0.99 * kDefaultSize;
  if (is_smaller) body.size = found->size;
  if (!is_given(request, "body.bricks") && !body.brick_size) body.bricks = found->bricks;
  if (!is_given(request, "solver.scheme")) film.solver.scheme = Solver::kAuto;
  observer.note(fmt::format(
      "material: {}, the softest that {} (sags {:.1f} %){}{}", body.material.name,
      scenario == Scenario::kHang ? "hangs in shape" : "stands", 100 * found->sag,
      is_smaller ? fmt::format(" at {}", readable(found->size, Dimension::kLength)) : "",
      found->material->material_class == MaterialClass::kGelatin ? "" : "; --material gelatin for a dessert"));
}

/// How a bare mesh is put down: its rotation (degrees about x, then y, then z) and its sides then, in file units.
struct Placement {
  Vec3 rotation = Vec3::Zero();
  Vec3 sides = Vec3::Ones();
  double drop = kDropHeight;  // in sizes: no higher than what makes it tip over
  bool is_turned = false;     // since it would tip over
};

/// Degrees about x, then y, then z, as rotation_matrix() takes them, to a hundredth.
Vec3 rotation_angles(const Mat3& rotation) {
  const double about_y = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
  const double about_x = std::atan2(rotation(2, 1), rotation(2, 2));
  const double about_z = std::atan2(rotation(1, 0), rotation(0, 0));
  return (Vec3(about_x, about_y, about_z) * (180 * 100 / std::numbers::pi)).array().round() / 100 + 0.0;
}

/// Upright; a body that is dropped and would tip over is laid down.
Placement put_down(const std::filesystem::path& file, UpAxis up, bool may_lie) {
  Placement placement;
  if (up == UpAxis::kZ) placement.rotation = Vec3(-90, 0, 0);
  const SurfaceMesh mesh = read_mesh(file);
  const Mat3 upright = rotation_matrix(placement.rotation);
  Points points = mesh.positions * upright.transpose();
  const Vec3 centre = upright * centre_of_mass(mesh);
  const Mat3 rolled = may_lie ? rolled_to_rest(points, centre) : Mat3(Mat3::Identity());
  if (!rolled.isIdentity(0)) {
    placement.rotation = rotation_angles(rolled * upright);
    placement.is_turned = Eigen::AngleAxisd(rolled).angle() > kWorthTelling;
    points = points * rolled.transpose();
  }
  placement.sides = points.colwise().maxCoeff() - points.colwise().minCoeff();
  if (may_lie) {
    const double rise = tipping_rise(points, rolled * centre) / placement.sides.maxCoeff();
    placement.drop = rise < kRoundRise ? kRoundDrop : std::min(rise, kDropHeight);
  }
  return placement;
}

/// Flat bodies are viewed from higher up, and bodies at rest fill a good part of the picture.
void place_camera(SceneCamera& camera, const Vec3& sides) {
  constexpr double kFlatness = 0.6;  // height over width below which the camera rises
  constexpr double kRise = 22;       // degrees, for a body without height
  constexpr double kBodyHeight = 0.44;
  const double width = std::max(sides.x(), sides.z());
  camera.elevation += kRise * std::clamp(1 - sides.y() / (kFlatness * width), 0.0, 1.0);
  camera.body_height = kBodyHeight;
}

/// Applies the options to a scene, except its materials, which make_scene() reads first.
void apply_settings(const SceneRequest& request, Film& film) {
  if (request.view) {
    film.camera.azimuth = request.view->azimuth;
    if (request.view->elevation) film.camera.elevation = *request.view->elevation;
    film.camera.keyframes.clear();
  }
  for (const Setting& setting : request.settings) {
    if (!is_of_materials(setting)) apply(setting, film);
  }
}

/// The request for a bare mesh, which no scene file describes: its defaults count as typed first.
SceneRequest without_defaults(SceneRequest request) {
  request.settings.insert(request.settings.begin(), request.defaults.begin(), request.defaults.end());
  request.defaults.clear();
  return request;
}

/// Sets what the scene file leaves open.
void apply_defaults(const SceneRequest& request, Film& film) {
  for (const Setting& setting : request.defaults) {
    if (is_of_materials(setting)) continue;
    try {
      set_if_unset(film, request.input, setting.key, setting.value);
    } catch (const Error& error) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", setting.option, error.what()));
    }
  }
}

Film make_bare_scene(const SceneRequest& request, const std::shared_ptr<const MaterialLibrary>& library,
                     const Observer& observer) {
  Film scene;
  scene.library = library;
  SceneBody& body = scene.bodies.emplace_back(default_body());
  body.mesh = std::filesystem::absolute(request.input).lexically_normal();
  const Scenario scenario = request.scenario.value_or(Scenario::kDrop);
  const UpAxis up = request.up.value_or(usual_up(request.input));
  const bool may_lie = scenario == Scenario::kDrop && !is_given(request, "body.rotation");
  const Placement placement = put_down(body.mesh, up, may_lie);
  body.rotation = placement.rotation;
  place_camera(scene.camera, placement.sides);
  apply_settings(request, scene);
  if (body.material.name == kAutoMaterial) choose_material(scene, request, scenario, observer);
  if (placement.is_turned) {
    observer.note(fmt::format(
        "pose: {} would tip over and is put down as it comes to rest; --set 'body.rotation=[{}, 0, 0]' for as it is",
        body.mesh.filename().string(), up == UpAxis::kZ ? -90 : 0));
  }
  const double scale = body.scale.value_or(body.size.value_or(kDefaultSize) / placement.sides.maxCoeff());
  stage_scenario(scene, scenario, scale * placement.sides.y(), up, placement.drop);
  if (!is_motion(scene)) stage_at_rest(scene, up);
  if (scenario == Scenario::kDrop && is_motion(scene) && !is_given(request, "duration")) {
    scene.duration = kLongestDrop;
    scene.until_still = kShortestDrop;
  }
  const Material chosen = body.material;
  apply_settings(request, scene);  // once more: what is typed wins over the scenario
  if (body.material.name == kAutoMaterial) body.material = chosen;
  tell_fits(scene, observer);
  return scene;
}

}  // namespace

void apply(const Setting& setting, Film& film) {
  try {
    set_scene_key(film, setting.key, setting.value);
    if (setting.key == "render.quality") film.render.samples.reset();  // what is typed wins over the scene's
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: {}", setting.option, error.what()));
  }
}

/// STL and 3MF come from printing, where z is up as in Blender; readers rotate files that name an axis.
UpAxis usual_up(const std::filesystem::path& mesh) {
  const std::string extension = lower_extension(mesh);
  return extension == ".stl" || extension == ".3mf" || extension == ".blend" ? UpAxis::kZ : UpAxis::kY;
}

Film make_part_scene(const SceneRequest& request) {
  Film scene;
  scene.library = library_of(request);
  SceneBody& body = scene.bodies.emplace_back(default_body());
  body.mesh = std::filesystem::absolute(request.input).lexically_normal();
  if (is_scene_file(body.mesh)) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' is a scene; give the mesh of a part", request.input));
  }
  apply_settings(without_defaults(request), scene);
  return scene;
}

Film make_scene(const SceneRequest& request, const Observer& observer) {
  const auto library = library_of(request);
  if (!is_scene_file(request.input)) return make_bare_scene(without_defaults(request), library, observer);
  if (request.scenario) {
    throw Error(ErrorKind::kUsage, "--scenario is for a bare mesh; a scene file says what happens");
  }
  if (request.up) {
    throw Error(ErrorKind::kUsage, "--up is for a bare mesh; in a scene file body.rotation = [-90, 0, 0] puts z up");
  }
  Film scene = read_scene(request.input, *library);
  apply_defaults(request, scene);
  apply_settings(request, scene);
  choose_materials(scene, observer);
  tell_fits(scene, observer);
  return scene;
}

}  // namespace sprung
