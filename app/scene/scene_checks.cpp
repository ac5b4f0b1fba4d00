#include "app/scene/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/text.h"

namespace sprung {
namespace {

constexpr std::string_view kMotions = "(solver.scheme euler, verlet, implicit-euler, bdf2 or auto)";

std::string list_of(const KeyRule& rule) {
  std::string text;
  for (const std::string_view key : rule.keys) text += fmt::format("{}'{}'", text.empty() ? "" : " or ", key);
  return text;
}

void check_rule(const KeyRule& rule, const std::vector<std::string_view>& all_given, const std::string& path,
                const Report& report) {
  std::vector<std::string_view> given;
  std::copy_if(rule.keys.begin(), rule.keys.end(), std::back_inserter(given), [&](std::string_view key) {
    return std::find(all_given.begin(), all_given.end(), key) != all_given.end();
  });
  if (rule.relation == KeyRule::kNeeds) {
    if (given.size() != 1 || given[0] != rule.keys[0]) return;
    report({given[0]}, fmt::format("{}: '{}' is for a {} with '{}'", path, given[0], path.substr(path.rfind('.') + 1),
                                   rule.keys[1]));
  } else if (given.empty() && rule.relation != KeyRule::kAtMostOne) {
    report({}, fmt::format("{} lacks the key {}", path, list_of(rule)));
  } else if (given.size() > 1 && rule.relation != KeyRule::kAnyOf) {
    report({given[1]}, fmt::format("{}: give {} or {}, not both", path, given[0], given[1]));
  }
}

template <class Keyframe>
void check_times(const std::vector<Keyframe>& keyframes, std::string_view key, const std::string& path,
                 const Report& report) {
  for (int i = 1; i < isize(keyframes); ++i) {
    if (keyframes[i].time > keyframes[i - 1].time) continue;
    report({key, i}, fmt::format("{}.keyframes: t = {} s is not after the keyframe before, {} s", path,
                                 keyframes[i].time, keyframes[i - 1].time));
  }
}

void check_direction(const Vec3& direction, KeyLocation place, const std::string& name, const Report& report) {
  if (direction.isZero(0)) report(place, name + ": must point somewhere");
}

void check_glue(const Film& film, const Report& report) {
  for (int i = 0; i < isize(film.glue); ++i) {
    const auto& bodies = film.glue[i].bodies;
    for (const int body : bodies) {
      if (body > isize(film.bodies)) report({"glue", i}, fmt::format("glue.bodies: there is no body {}", body));
    }
    const bool is_alone =
        bodies[0] == bodies[1] && bodies[0] <= isize(film.bodies) && copy_count(film.bodies[bodies[0] - 1]) == 1;
    if (is_alone) report({"glue", i}, fmt::format("glue.bodies: body {} has no copies", bodies[0]));
  }
}

void check_probes(const Film& film, const Report& report) {
  for (int i = 0; i < isize(film.probes); ++i) {
    const Probe& probe = film.probes[i];
    if (probe.body < 1 || probe.body > isize(film.bodies)) {
      report({"probe", i}, fmt::format("probe.body: there is no body {}", probe.body));
    } else if (!probe.pin.empty()) {
      std::vector<std::string_view> names;
      for (const Pin& pin : film.bodies[probe.body - 1].pins) names.push_back(pin.name);
      if (std::find(names.begin(), names.end(), probe.pin) != names.end()) continue;
      report({"probe", i},
             fmt::format("probe.pin: the body has no pin '{}'{}", probe.pin, did_you_mean(probe.pin, names)));
    }
  }
}

/// Statics has weights, pins and forces only, and no events in time.
void check_rest(const Film& film, const Report& report) {
  for (const MotionOnly& part : motion_only(film)) {
    report({part.key, part.key == "body" ? int(part.row) : -1},
           fmt::format("only in a motion {} can there be {}", kMotions, part.what));
  }
  for (int i = 0; i < isize(film.bodies); ++i) {
    const std::vector<Pin>& pins = film.bodies[i].pins;
    const auto is_timed = [](const Pin& pin) { return pin.from > 0 || pin.until; };
    if (std::none_of(pins.begin(), pins.end(), is_timed)) continue;
    report({"body", i},
           fmt::format("body.pin: only in a motion {} can a pin begin late or release its nodes", kMotions));
  }
  if (!film.obstacles.empty())
    report({"obstacle", 0}, fmt::format("only a motion {} can have an [[obstacle]]", kMotions));
}

}  // namespace

void check_rules(const std::vector<KeyRule>& rules, const std::vector<std::string_view>& given, const std::string& path,
                 const Report& report) {
  for (const KeyRule& rule : rules) check_rule(rule, given, path, report);
}

void check_table(const Film& film, const std::string&, const Report& report) {
  check_probes(film, report);
  check_glue(film, report);
  check_times(film.gravity_keyframes, "gravity_keyframes", "scene", report);
  if (!is_motion(film)) check_rest(film, report);
}

/// A brick's law depends on its Poisson's ratio in many constants, on its stiffness in one factor.
void check_table(const SceneBody& body, const std::string& path, const Report& report) {
  const auto check_material = [&](int row, const Material& material) {
    if (material.name == kAutoMaterial) {
      report({"region", row}, fmt::format("{}.region: only a body's material can be \"auto\"; name this one", path));
      return;
    }
    if (material.law != body.material.law) {
      report({"region", row},
             fmt::format("{}.region: its law is {}, that of the body {}; the materials of one body may "
                         "differ in stiffness and density only",
                         path, law_text(material.law), law_text(body.material.law)));
    }
    if (material.poisson == body.material.poisson) return;
    if (material.in_motion().poisson == body.material.in_motion().poisson) return;
    report({"region", row}, fmt::format("{}.region: its Poisson's ratio {} is not that of the body, {}; the materials "
                                        "of one body may differ in stiffness and density only",
                                        path, material.poisson, body.material.poisson));
  };
  const auto on_surface =
      std::count_if(body.pins.begin(), body.pins.end(), [](const Pin& pin) { return pin.on_surface; });
  if (on_surface > 0 && on_surface < isize(body.pins)) {
    report({"pin"}, fmt::format("{}.pin: give all pins of a body on_surface, or none", path));
  }
  for (int i = 0; i < isize(body.regions); ++i) {
    check_material(i, body.regions[i].material);
    if (body.regions[i].gradient) check_material(i, body.regions[i].gradient->material);
  }
}

void check_table(const Pin& pin, const std::string& path, const Report& report) {
  if (pin.until && *pin.until <= pin.from) report({"until"}, fmt::format("{0}.until: must be after {0}.from", path));
  if (pin.normal) {
    check_direction(*pin.normal, {}, path + ".normal", report);
    if (!pin.on_surface) report({"normal"}, fmt::format("{}: normal is for a pin with on_surface = true", path));
    const std::array<bool, 3>& fixed = pin.axes.fixed;
    if (!(fixed[0] && fixed[1] && fixed[2])) report({"axes"}, fmt::format("{}: give axes or normal, not both", path));
  }
  if (pin.keyframes.empty()) return;
  check_times(pin.keyframes, "keyframes", path, report);
  const Keyframe& first = pin.keyframes.front();
  if (first.time > 0 || Movement({first}, pin.interpolation).is_still()) return;
  report({"keyframes", 0},
         fmt::format("{}.keyframes: at t = 0 the nodes are where the body is; move that, or begin later", path));
}

void check_table(const SceneObstacle& obstacle, const std::string& path, const Report& report) {
  if (!obstacle.mesh.empty() && !obstacle.size && !obstacle.scale) {
    report({}, fmt::format("{} lacks the key 'size' or 'scale': how large the mesh is", path));
  }
  if (obstacle.plane) check_direction(obstacle.plane->normal, {"plane"}, path + ".plane.normal", report);
  if (obstacle.interpolation == Interpolation::kHeld) {
    report({"interpolation"}, fmt::format("{}.interpolation: an obstacle cannot jump; linear or smooth", path));
  }
  check_times(obstacle.keyframes, "keyframes", path, report);
  for (int i = 0; i < isize(obstacle.keyframes); ++i) {
    if (obstacle.keyframes[i].scale == 1) continue;
    report({"keyframes", i}, fmt::format("{}.keyframes: an obstacle keeps its size", path));
  }
}

void check_table(const BodyForce& force, const std::string& path, const Report& report) {
  check_times(force.keyframes, "keyframes", path, report);
  if (!force.on_surface || force.total) return;
  report({"on_surface"}, fmt::format("{}: on_surface is for a force with 'total'", path));
}

void check_table(const BodyMuscle& muscle, const std::string& path, const Report& report) {
  check_times(muscle.keyframes, "keyframes", path, report);
  check_direction(muscle.direction, {}, path + ".direction", report);
}

void check_table(const SceneWind& wind, const std::string& path, const Report& report) {
  check_times(wind.keyframes, "keyframes", path, report);
}

namespace {

void check_law(const StrainEnergyLaw& law, bool is_fitted, const std::string& path, const Report& report) {
  const std::string fault = is_fitted ? "" : find_fault(law);
  if (!fault.empty()) report({"law"}, fmt::format("{}: {}", path, fault));
}

}  // namespace

void check_table(const Material& material, const std::string& path, const Report& report) {
  check_law(material.law, !material.curve.empty(), path, report);
}

void check_table(const LibraryMaterial& material, const std::string& path, const Report& report) {
  check_law(material.law, !material.curve.empty(), path, report);
  const double ultimate = material.ultimate_strength;
  if (ultimate == 0 || material.yield_strength <= ultimate) return;
  report({"yield_strength"}, fmt::format("{}.yield_strength: {} is above the ultimate strength, {}", path,
                                         readable(material.yield_strength, Dimension::kPressure),
                                         readable(ultimate, Dimension::kPressure)));
}

void check_table(const HalfSpace& half, const std::string& path, const Report& report) {
  check_direction(half.normal, {}, path + ".normal", report);
}

void check_table(const Gradient& gradient, const std::string& path, const Report& report) {
  if (gradient.from == gradient.to) report({}, fmt::format("{}: from and to are the same place", path));
}

void check_table(const TorusShape& torus, const std::string& path, const Report& report) {
  if (torus.tube < torus.radius) return;
  report({}, fmt::format("{}: the tube must be thinner than the radius, or there is no hole", path));
}

/// A flat box is a face.
void check_table(const Box& box, const std::string& path, const Report& report) {
  if ((box.min.array() <= box.max.array()).all()) return;
  report({}, fmt::format("{}: min must not be above max along any axis", path));
}

}  // namespace sprung
