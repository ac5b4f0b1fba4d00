#pragma once
#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include "app/scene/scene.h"
#include "app/units.h"

namespace sprung {

/// The numbers that a key takes.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false;  // low itself is outside
  bool without_high = false;
};

/// What is known of a key, whatever it belongs to.
struct KeyInfo {
  std::string_view name;
  std::string_view help;
  Dimension dimension = Dimension::kNone;
  Range range{};
  bool required = false;
  std::span<const int> choices{};  // where not empty: the only numbers it takes
};

/// The field that a key sets. Its type is the type of the key, its value in a new Owner the default.
template <class Owner>
using Member = std::variant<
    double Owner::*, std::optional<double> Owner::*, int Owner::*, std::optional<int> Owner::*,
    std::optional<BrickCount> Owner::*, Vec3 Owner::*, std::optional<Vec3> Owner::*, std::array<int, 2> Owner::*,
    std::array<int, 3> Owner::*, std::string Owner::*, std::filesystem::path Owner::*, Solver Owner::*,
    RepairMode Owner::*, Model Owner::*, std::optional<Model> Owner::*, Axes Owner::*, Interpolation Owner::*,
    std::optional<Color> Owner::*, Material Owner::*, std::optional<Box> Owner::*, std::optional<Ball> Owner::*,
    std::optional<HalfSpace> Owner::*, std::optional<Gradient> Owner::*, std::optional<SphereShape> Owner::*,
    std::optional<CylinderShape> Owner::*, std::optional<TorusShape> Owner::*, std::optional<Copies> Owner::*,
    Plane Owner::*, SceneCamera Owner::*, SceneRender Owner::*, SceneSolver Owner::*, Experiment Owner::*,
    std::vector<double> Owner::*, std::vector<int> Owner::*, std::vector<Model> Owner::*,
    std::vector<Keyframe> Owner::*, std::vector<Pin> Owner::*, std::vector<Region> Owner::*, std::vector<Cut> Owner::*,
    std::vector<SceneBody> Owner::*, std::vector<Obstacle> Owner::*, std::vector<Probe> Owner::*,
    std::vector<Gate> Owner::*, std::vector<Expectation> Owner::*>;

template <class Owner>
struct Key : KeyInfo {
  Member<Owner> member;
};

/// The one table of what a scene file may say; parser, printer and options are built on it. One part for each struct
/// of scene.h, and Material for what a material written out in a scene may say.
template <class Owner>
[[nodiscard]] std::span<const Key<Owner>> keys();

template <>
std::span<const Key<Scene>> keys();
template <>
std::span<const Key<SceneBody>> keys();
template <>
std::span<const Key<Material>> keys();
template <>
std::span<const Key<Pin>> keys();
template <>
std::span<const Key<Keyframe>> keys();
template <>
std::span<const Key<Box>> keys();
template <>
std::span<const Key<Ball>> keys();
template <>
std::span<const Key<HalfSpace>> keys();
template <>
std::span<const Key<Gradient>> keys();
template <>
std::span<const Key<SphereShape>> keys();
template <>
std::span<const Key<CylinderShape>> keys();
template <>
std::span<const Key<TorusShape>> keys();
template <>
std::span<const Key<Copies>> keys();
template <>
std::span<const Key<Obstacle>> keys();
template <>
std::span<const Key<Plane>> keys();
template <>
std::span<const Key<SceneCamera>> keys();
template <>
std::span<const Key<SceneRender>> keys();
template <>
std::span<const Key<SceneSolver>> keys();
template <>
std::span<const Key<Region>> keys();
template <>
std::span<const Key<Cut>> keys();
template <>
std::span<const Key<Probe>> keys();
template <>
std::span<const Key<Experiment>> keys();
template <>
std::span<const Key<Gate>> keys();
template <>
std::span<const Key<Expectation>> keys();

/// What holds between the keys of one table.
struct KeyRule {
  enum class Kind {
    kOneOf,      // exactly one of them
    kAnyOf,      // one at least
    kAtMostOne,  // two exclude each other
    kNeeds       // the first only with the second
  };
  Kind kind;
  std::vector<std::string_view> keys;
};

template <class Owner>
[[nodiscard]] std::span<const KeyRule> rules() {
  return {};
}
template <>
std::span<const KeyRule> rules<SceneBody>();
template <>
std::span<const KeyRule> rules<Pin>();
template <>
std::span<const KeyRule> rules<Region>();
template <>
std::span<const KeyRule> rules<Cut>();
template <>
std::span<const KeyRule> rules<Probe>();
template <>
std::span<const KeyRule> rules<Gate>();

/// The key of that name, or null.
template <class Owner>
[[nodiscard]] const Key<Owner>* find_key(std::string_view name) {
  for (const Key<Owner>& key : keys<Owner>()) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

template <class Owner>
[[nodiscard]] std::vector<std::string_view> key_names() {
  std::vector<std::string_view> names;
  for (const Key<Owner>& key : keys<Owner>()) names.push_back(key.name);
  return names;
}

}  // namespace sprung
