#include "app/scene/selection_keys.h"

namespace sprung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kPositive{.low = 0, .without_low = true};

const Key<Strength> kStrength[] = {
    {{"t", "when", Dimension::kTime, {0, kInfinity}, true}, &Strength::time},
    {{"strength", "times what it is at full strength", Dimension::kRatio, {}, true}, &Strength::strength},
};

/// And how strong a load is over time, whatever the load is.
template <class Owner>
std::vector<Key<Owner>> and_course(std::vector<Key<Owner>> keys) {
  keys.push_back({{"keyframes", "how strong it is at which times"}, &Owner::keyframes});
  keys.push_back({{"interpolation", "between keyframes: linear, smooth or held"}, &Owner::interpolation});
  return keys;
}

const Key<BodyForce> kForceOnly[] = {
    {{"total", "on all of the part, shared out by volume", Dimension::kForce}, &BodyForce::total},
    {{"per_volume", "on each volume of the part", Dimension::kForceDensity}, &BodyForce::per_volume},
    {{"pressure", "on the skin of the part, inward", Dimension::kPressure}, &BodyForce::pressure},
};

const Key<BodyMuscle> kMuscleOnly[] = {
    {{"direction", "along which it contracts, in the body before it is turned", Dimension::kNone, {}, true},
     &BodyMuscle::direction},
    {{"contraction",
      "share of its length; across it widens as much as keeps the volume",
      Dimension::kRatio,
      {-1, 0.9},
      true},
     &BodyMuscle::contraction},
};

const Key<GravityKeyframe> kGravityKeyframe[] = {
    {{"t", "when", Dimension::kTime, {0, kInfinity}, true}, &GravityKeyframe::time},
    {{"gravity", "acceleration of everything", Dimension::kAcceleration, {}, true}, &GravityKeyframe::gravity},
};

const Key<SceneWind> kWindOnly[] = {
    {{"velocity", "of the air at strength 1", Dimension::kSpeed, {}, true}, &SceneWind::velocity},
    {{"density", "of the air", Dimension::kDensity, kPositive}, &SceneWind::density},
    {{"drag", "coefficient: pressure on what faces the air, over density v^2 / 2", Dimension::kRatio, {0, kInfinity}},
     &SceneWind::drag},
};

const Key<SceneGlue> kGlue[] = {
    {{"bodies", "which two, counted from 1; the same twice: its copies", Dimension::kNone, {1, kInfinity}, true},
     &SceneGlue::bodies},
    {{"distance", "how far apart skins may be to hold; half the smaller bricks", Dimension::kLength, kPositive},
     &SceneGlue::distance},
};

using Kind = KeyRule::Kind;

}  // namespace

template <>
std::span<const Key<Strength>> keys() {
  return kStrength;
}
template <>
std::span<const Key<BodyForce>> keys() {
  static const std::vector<Key<BodyForce>> all = and_course(selection_and<BodyForce>(kForceOnly));
  return all;
}
template <>
std::span<const Key<BodyMuscle>> keys() {
  static const std::vector<Key<BodyMuscle>> all = and_course(selection_and<BodyMuscle>(kMuscleOnly));
  return all;
}
template <>
std::span<const Key<GravityKeyframe>> keys() {
  return kGravityKeyframe;
}
template <>
std::span<const Key<SceneWind>> keys() {
  static const std::vector<Key<SceneWind>> all = and_course(std::vector(std::begin(kWindOnly), std::end(kWindOnly)));
  return all;
}
template <>
std::span<const Key<SceneGlue>> keys() {
  return kGlue;
}

template <>
std::span<const KeyRule> rules<BodyForce>() {
  static const std::vector<KeyRule> all{one_selection(Kind::kAtMostOne),
                                        {Kind::kOneOf, {"total", "per_volume", "pressure"}}};
  return all;
}
template <>
std::span<const KeyRule> rules<BodyMuscle>() {
  static const std::vector<KeyRule> all{one_selection(Kind::kAtMostOne)};
  return all;
}

}  // namespace sprung
