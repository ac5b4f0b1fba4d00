#pragma once
#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include "app/scene/film.h"
#include "core/units.h"

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

/// The types that the keys of one table may have.
template <class... Values>
struct Types {
  template <class Owner>
  using Member = std::variant<Values Owner::*...>;
};

/// The types of the keys of a table, each listed where it is used: code is made for every pair of table and type.
template <class Owner>
struct KeyTypes;
template <>
struct KeyTypes<Film>
    : Types<std::filesystem::path, double, Vec3, std::vector<GravityKeyframe>, std::optional<SceneWind>,
            std::vector<SceneGlue>, SceneSolver, SceneContact, SceneCamera, SceneRender, std::vector<SceneBody>,
            std::vector<SceneObstacle>, std::vector<Probe>, Experiment, std::vector<Expectation>> {};
template <>
struct KeyTypes<SceneSolver> : Types<Solver, std::optional<int>, int, double> {};
template <>
struct KeyTypes<SceneCamera> : Types<double, bool, std::vector<CameraKeyframe>> {};
template <>
struct KeyTypes<CameraKeyframe> : Types<double> {};
template <>
struct KeyTypes<SceneRender>
    : Types<std::array<int, 2>, Quality, std::optional<int>, bool, double, std::optional<std::array<int, 2>>, Field,
            std::optional<ColorMap>, std::optional<double>, std::string, BrickView, std::optional<HalfSpace>,
            std::filesystem::path> {};
template <>
struct KeyTypes<SceneBody>
    : Types<std::filesystem::path, std::optional<Vec3>, std::optional<SphereShape>, std::optional<CylinderShape>,
            std::optional<TorusShape>, std::vector<Cut>, std::optional<double>, RepairMode, Vec3,
            std::optional<BrickCount>, Material, Model, std::optional<Color>, std::optional<Copies>, std::vector<Pin>,
            std::vector<Region>, std::vector<BodyForce>, std::vector<BodyMuscle>, double, std::optional<Look>,
            SkinInterpolation> {};
template <>
struct KeyTypes<Strength> : Types<double> {};
template <>
struct KeyTypes<GravityKeyframe> : Types<double, Vec3> {};
template <>
struct KeyTypes<BodyForce>
    : Types<std::optional<Box>, std::optional<Ball>, std::optional<HalfSpace>, std::string, std::optional<Color>,
            std::optional<Vec3>, std::filesystem::path, std::optional<double>, std::vector<Strength>, Interpolation> {};
template <>
struct KeyTypes<BodyMuscle>
    : Types<std::optional<Box>, std::optional<Ball>, std::optional<HalfSpace>, std::string, std::optional<Color>,
            std::optional<Vec3>, std::filesystem::path, Vec3, double, std::vector<Strength>, Interpolation> {};
template <>
struct KeyTypes<SceneWind> : Types<Vec3, double, std::vector<Strength>, Interpolation> {};
template <>
struct KeyTypes<SceneGlue> : Types<std::array<int, 2>, std::optional<double>> {};
template <>
struct KeyTypes<Material> : Types<double> {};
template <>
struct KeyTypes<SphereShape> : Types<double> {};
template <>
struct KeyTypes<CylinderShape> : Types<double> {};
template <>
struct KeyTypes<TorusShape> : Types<double> {};
template <>
struct KeyTypes<Copies> : Types<std::array<int, 3>, Vec3, double, int> {};
template <>
struct KeyTypes<Pin> : Types<std::optional<Box>, std::optional<Ball>, std::optional<HalfSpace>, std::string,
                             std::optional<Color>, std::optional<Vec3>, std::filesystem::path, Axes,
                             std::vector<Keyframe>, Interpolation, double, std::optional<double>> {};
template <>
struct KeyTypes<Keyframe> : Types<double, Vec3> {};
template <>
struct KeyTypes<Region>
    : Types<std::optional<Box>, std::optional<Ball>, std::optional<HalfSpace>, std::string, std::optional<Color>,
            std::optional<Vec3>, std::filesystem::path, Material, std::optional<Gradient>> {};
template <>
struct KeyTypes<Gradient> : Types<Vec3, Material> {};
template <>
struct KeyTypes<Cut> : Types<std::optional<Box>, std::optional<Ball>, std::optional<HalfSpace>, std::string,
                             std::optional<Color>, std::optional<Vec3>, std::filesystem::path> {};
template <>
struct KeyTypes<Box> : Types<Vec3> {};
template <>
struct KeyTypes<Ball> : Types<Vec3, double> {};
template <>
struct KeyTypes<HalfSpace> : Types<Vec3> {};
template <>
struct KeyTypes<SceneObstacle>
    : Types<std::optional<Plane>, std::optional<Vec3>, std::optional<SphereShape>, std::optional<CapsuleShape>,
            std::optional<CylinderShape>, std::filesystem::path, std::optional<double>, Vec3, std::vector<Keyframe>,
            Interpolation, double, std::optional<Color>> {};
template <>
struct KeyTypes<Plane> : Types<double, Vec3> {};
template <>
struct KeyTypes<CapsuleShape> : Types<double> {};
template <>
struct KeyTypes<SceneContact> : Types<bool> {};
template <>
struct KeyTypes<Probe> : Types<std::string, int, std::optional<Vec3>> {};
template <>
struct KeyTypes<Experiment>
    : Types<std::string, std::filesystem::path, std::vector<Model>, std::vector<double>, std::vector<int>> {};
template <>
struct KeyTypes<Expectation>
    : Types<std::string, double, std::vector<double>, std::vector<int>, std::vector<Model>, std::vector<Gate>> {};
template <>
struct KeyTypes<Gate> : Types<std::vector<Model>, std::vector<int>, std::optional<double>, std::optional<Model>> {};

/// The field that a key sets. Its type is the type of the key, its value in a new Owner the default.
template <class Owner>
using Member = typename KeyTypes<Owner>::template Member<Owner>;

template <class Owner>
struct Key : KeyInfo {
  Member<Owner> member;
};

/// The one table of what a scene file may say; parser, printer and options are built on it. One part for each struct
/// of scene.h, and Material for what a material written out in a scene may say.
template <class Owner>
[[nodiscard]] std::span<const Key<Owner>> keys();

template <>
std::span<const Key<Film>> keys();
template <>
std::span<const Key<SceneBody>> keys();
template <>
std::span<const Key<Material>> keys();
template <>
std::span<const Key<Pin>> keys();
template <>
std::span<const Key<Keyframe>> keys();
template <>
std::span<const Key<Strength>> keys();
template <>
std::span<const Key<GravityKeyframe>> keys();
template <>
std::span<const Key<BodyForce>> keys();
template <>
std::span<const Key<BodyMuscle>> keys();
template <>
std::span<const Key<SceneWind>> keys();
template <>
std::span<const Key<SceneGlue>> keys();
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
std::span<const Key<CapsuleShape>> keys();
template <>
std::span<const Key<SceneContact>> keys();
template <>
std::span<const Key<SceneObstacle>> keys();
template <>
std::span<const Key<Plane>> keys();
template <>
std::span<const Key<SceneCamera>> keys();
template <>
std::span<const Key<CameraKeyframe>> keys();
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
std::span<const KeyRule> rules<BodyForce>();
template <>
std::span<const KeyRule> rules<BodyMuscle>();
template <>
std::span<const KeyRule> rules<SceneObstacle>();
template <>
std::span<const KeyRule> rules<Probe>();
template <>
std::span<const KeyRule> rules<Gate>();

/// What stands where nothing is said.
template <class Owner>
[[nodiscard]] Owner default_owner() {
  return Owner{};
}
template <>
[[nodiscard]] inline SceneBody default_owner() {
  return default_body();
}

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
