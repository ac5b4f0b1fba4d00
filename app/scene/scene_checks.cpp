#include "app/scene/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/text.h"

namespace sprung {
namespace {

std::string list_of(const KeyRule& rule) {
  std::string text;
  for (const std::string_view key : rule.keys) text += fmt::format("{}'{}'", text.empty() ? "" : " or ", key);
  return text;
}

void check_rule(const toml::table& table, const std::string& path, const KeyRule& rule, SceneMistakes& mistakes) {
  using Kind = KeyRule::Kind;
  std::vector<std::string_view> given;
  std::copy_if(rule.keys.begin(), rule.keys.end(), std::back_inserter(given),
               [&](std::string_view key) { return table.contains(key); });
  if (rule.kind == Kind::kNeeds) {
    if (given.size() != 1 || given[0] != rule.keys[0]) return;
    mistakes.add(table.get(given[0])->source(), fmt::format("{}: '{}' is for a {} with '{}'", path, given[0],
                                                            path.substr(path.rfind('.') + 1), rule.keys[1]));
  } else if (given.empty() && rule.kind != Kind::kAtMostOne) {
    mistakes.add(table.source(), fmt::format("{} lacks the key {}", path, list_of(rule)));
  } else if (given.size() > 1 && rule.kind != Kind::kAnyOf) {
    mistakes.add(table.get(given[1])->source(), fmt::format("{}: give {} or {}, not both", path, given[0], given[1]));
  }
}

/// A brick's law depends on its Poisson's ratio in many constants, on its stiffness in one factor.
void check_regions(const toml::array& regions, const std::string& path, const SceneBody& body,
                   SceneMistakes& mistakes) {
  const auto check = [&](const toml::node& place, const Material& material) {
    if (material.poisson == body.material.poisson) return;
    mistakes.add(place.source(),
                 fmt::format("{}.region: its Poisson's ratio {} is not that of the body, {}; the materials of one "
                             "body may differ in stiffness and density only",
                             path, material.poisson, body.material.poisson));
  };
  for (std::size_t i = 0; i < body.regions.size(); ++i) {
    check(regions[i], body.regions[i].material);
    if (body.regions[i].gradient) check(regions[i], body.regions[i].gradient->material);
  }
}

void check_pin(const toml::node& node, const std::string& name, const SceneBody& body, SceneMistakes& mistakes) {
  std::vector<std::string_view> names;
  for (const Pin& pin : body.pins) names.push_back(pin.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  mistakes.add(node.source(), fmt::format("probe.pin: the body has no pin '{}'{}", name, did_you_mean(name, names)));
}

/// Of whatever has times that have to grow.
template <class Timed>
void check_times(const toml::array& places, const std::string& path, const std::vector<Timed>& keyframes,
                 SceneMistakes& mistakes) {
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    if (keyframes[i].time > keyframes[i - 1].time) continue;
    mistakes.add(places[i].source(), fmt::format("{}.keyframes: t = {} s is not after the keyframe before, {} s", path,
                                                 keyframes[i].time, keyframes[i - 1].time));
  }
}

void check_course(const toml::table& table, const std::string& path, const StrengthCurve& course,
                  SceneMistakes& mistakes) {
  if (!course.keyframes.empty()) {
    check_times(*table.get("keyframes")->as_array(), path, course.keyframes, mistakes);
  }
}

void check_glue(const toml::array& all, const Film& scene, SceneMistakes& mistakes) {
  for (std::size_t i = 0; i < scene.glue.size(); ++i) {
    const auto& bodies = scene.glue[i].bodies;
    for (const int body : bodies) {
      if (std::size_t(body) <= scene.bodies.size()) continue;
      mistakes.add(all[i].source(), fmt::format("glue.bodies: there is no body {}", body));
    }
    const bool is_alone = bodies[0] == bodies[1] && std::size_t(bodies[0]) <= scene.bodies.size() &&
                          copy_count(scene.bodies[bodies[0] - 1]) == 1;
    if (is_alone) mistakes.add(all[i].source(), fmt::format("glue.bodies: body {} has no copies", bodies[0]));
  }
}

constexpr std::string_view kMotionOnly =
    "only in a motion (solver.scheme euler, verlet, implicit-euler, bdf2 or auto) can there be";

/// What acts on a body at rest is its weight, what its pins do, and forces that grow with them.
void check_resting(const toml::table& table, const Film& scene, SceneMistakes& mistakes) {
  for (const MotionOnly& part : motion_only(scene)) {
    const toml::node* place = table.get(part.key);
    if (part.key == "body") place = place->as_array()->get(part.row);
    mistakes.add(place->source(), fmt::format("{} {}", kMotionOnly, part.what));
  }
}

/// Nothing can fall where there is no time.
void check_holding(const toml::array& bodies, const Film& scene, SceneMistakes& mistakes) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::vector<Pin>& pins = scene.bodies[i].pins;
    const auto is_short = [](const Pin& pin) { return pin.from > 0 || pin.until; };
    if (std::none_of(pins.begin(), pins.end(), is_short)) continue;
    mistakes.add(bodies[i].source(),
                 "body.pin: only in a motion (solver.scheme euler, verlet, implicit-euler, bdf2 or "
                 "auto) can a pin take its nodes late or let them go");
  }
}

void check_probes(const toml::array& probes, const Film& scene, SceneMistakes& mistakes) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const Probe& probe = scene.probes[i];
    const std::size_t body = probe.body - 1;
    if (body >= scene.bodies.size()) {
      mistakes.add(probes[i].source(), fmt::format("probe.body: there is no body {}", probe.body));
    } else if (!probe.pin.empty()) {
      check_pin(probes[i], probe.pin, scene.bodies[body], mistakes);
    }
  }
}

}  // namespace

void check_rules(const toml::table& table, const std::string& path, std::span<const KeyRule> rules,
                 SceneMistakes& mistakes) {
  for (const KeyRule& rule : rules) check_rule(table, path, rule, mistakes);
}

void check_together(const toml::table& table, const std::string& path, const SceneBody& body, SceneMistakes& mistakes) {
  if (!body.regions.empty()) check_regions(*table.get("region")->as_array(), path, body, mistakes);
}

void check_together(const toml::table& table, const std::string& path, const Pin& pin, SceneMistakes& mistakes) {
  if (pin.until && *pin.until <= pin.from) {
    mistakes.add(table.get("until")->source(), fmt::format("{}.until: must be after {}.from", path, path));
  }
  if (pin.keyframes.empty()) return;
  const toml::array& places = *table.get("keyframes")->as_array();
  check_times(places, path, pin.keyframes, mistakes);
  const Keyframe& first = pin.keyframes.front();
  if (first.time > 0 || Movement({first}, pin.interpolation).is_still()) return;
  mistakes.add(places[0].source(),
               fmt::format("{}.keyframes: at t = 0 the nodes are where the body is; move that, or begin later", path));
}

void check_together(const toml::table& table, const std::string& path, const SceneObstacle& obstacle,
                    SceneMistakes& mistakes) {
  if (!obstacle.mesh.empty() && !obstacle.size && !obstacle.scale) {
    mistakes.add(table.source(), fmt::format("{} lacks the key 'size' or 'scale': how large the mesh is", path));
  }
  if (obstacle.plane && obstacle.plane->normal.isZero(0)) {
    mistakes.add(table.get("plane")->source(), fmt::format("{}.plane.normal: must point somewhere", path));
  }
  if (obstacle.interpolation == Interpolation::kHeld) {
    mistakes.add(table.get("interpolation")->source(),
                 fmt::format("{}.interpolation: an obstacle cannot jump; linear or smooth", path));
  }
  if (obstacle.keyframes.empty()) return;
  const toml::array& places = *table.get("keyframes")->as_array();
  check_times(places, path, obstacle.keyframes, mistakes);
  for (std::size_t i = 0; i < obstacle.keyframes.size(); ++i) {
    if (obstacle.keyframes[i].scale == 1) continue;
    mistakes.add(places[i].source(), fmt::format("{}.keyframes: an obstacle keeps its size", path));
  }
}

void check_together(const toml::table& table, const std::string& path, const BodyForce& force,
                    SceneMistakes& mistakes) {
  check_course(table, path, force, mistakes);
}

void check_together(const toml::table& table, const std::string& path, const BodyMuscle& muscle,
                    SceneMistakes& mistakes) {
  check_course(table, path, muscle, mistakes);
  if (!muscle.direction.isZero(0)) return;
  mistakes.add(table.source(), fmt::format("{}.direction: must point somewhere", path));
}

void check_together(const toml::table& table, const std::string& path, const SceneWind& wind, SceneMistakes& mistakes) {
  check_course(table, path, wind, mistakes);
}

void check_together(const toml::table& table, const std::string& path, const HalfSpace& half, SceneMistakes& mistakes) {
  if (!half.normal.isZero(0)) return;
  mistakes.add(table.source(), fmt::format("{}.normal: must point somewhere", path));
}

void check_together(const toml::table& table, const std::string& path, const Gradient& change,
                    SceneMistakes& mistakes) {
  if (change.from != change.to) return;
  mistakes.add(table.source(), fmt::format("{}: from and to are the same place", path));
}

void check_together(const toml::table& table, const std::string& path, const TorusShape& ring,
                    SceneMistakes& mistakes) {
  if (ring.tube < ring.radius) return;
  mistakes.add(table.source(), fmt::format("{}: the tube must be thinner than the radius, or there is no hole", path));
}

void check_together(const toml::table& table, const std::string& path, const Box& box, SceneMistakes& mistakes) {
  if ((box.min.array() < box.max.array()).all()) return;
  mistakes.add(table.source(), fmt::format("{}: min must be below max along every axis", path));
}

void check_together(const toml::table& table, const std::string&, const Film& scene, SceneMistakes& mistakes) {
  if (!scene.probes.empty()) check_probes(*table.get("probe")->as_array(), scene, mistakes);
  if (!scene.glue.empty()) check_glue(*table.get("glue")->as_array(), scene, mistakes);
  if (!scene.gravity_keyframes.empty()) {
    check_times(*table.get("gravity_keyframes")->as_array(), "scene", scene.gravity_keyframes, mistakes);
  }
  if (!is_motion(scene)) check_resting(table, scene, mistakes);
  if (!is_motion(scene) && !scene.bodies.empty()) check_holding(*table.get("body")->as_array(), scene, mistakes);
  if (scene.obstacles.empty() || is_motion(scene)) return;
  mistakes.add((*table.get("obstacle")->as_array())[0].source(),
               "only a motion (solver.scheme euler, verlet, implicit-euler, bdf2 or auto) meets an [[obstacle]]");
}

}  // namespace sprung
