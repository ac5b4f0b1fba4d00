#pragma once
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "app/scene/film.h"

namespace sprung {

/// What the values of a type are called, and what a person calls such a value.
template <class Value, std::size_t count>
struct Names {
  std::string_view thing;
  std::array<std::pair<std::string_view, Value>, count> values;
};

/// Of the types whose values are written as names.
template <class Value>
inline constexpr bool kNames = false;

template <>
inline constexpr Names<Solver, 8> kNames<Solver>{"scheme",
                                                 {{{"auto", Solver::kAuto},
                                                   {"euler", Solver::kEuler},
                                                   {"verlet", Solver::kVerlet},
                                                   {"implicit-euler", Solver::kImplicitEuler},
                                                   {"bdf2", Solver::kBdf2},
                                                   {"static", Solver::kStatic},
                                                   {"linear", Solver::kLinear},
                                                   {"modes", Solver::kModes}}}};
template <>
inline constexpr Names<RepairMode, 3> kNames<RepairMode>{
    "way of repair", {{{"off", RepairMode::kOff}, {"auto", RepairMode::kAuto}, {"strict", RepairMode::kStrict}}}};
template <>
inline constexpr Names<Interpolation, 3> kNames<Interpolation>{
    "interpolation",
    {{{"linear", Interpolation::kLinear}, {"smooth", Interpolation::kSmooth}, {"held", Interpolation::kHeld}}}};
template <>
inline constexpr Names<Quality, 3> kNames<Quality>{
    "quality", {{{"preview", Quality::kPreview}, {"default", Quality::kDefault}, {"high", Quality::kHigh}}}};
template <>
inline constexpr Names<Field, 9> kNames<Field>{"field",
                                               {{{"skin", Field::kSkin},
                                                 {"displacement", Field::kDisplacement},
                                                 {"speed", Field::kSpeed},
                                                 {"stretch", Field::kStretch},
                                                 {"strain", Field::kStrain},
                                                 {"stress", Field::kStress},
                                                 {"volume", Field::kVolume},
                                                 {"fill", Field::kFill},
                                                 {"region", Field::kRegion}}}};
template <>
inline constexpr Names<ColorMap, 5> kNames<ColorMap>{"colour map",
                                                     {{{"viridis", ColorMap::kViridis},
                                                       {"cividis", ColorMap::kCividis},
                                                       {"coolwarm", ColorMap::kCoolwarm},
                                                       {"ember", ColorMap::kEmber},
                                                       {"turbo", ColorMap::kTurbo}}}};
template <>
inline constexpr Names<BrickView, 3> kNames<BrickView>{
    "view of bricks", {{{"none", BrickView::kNone}, {"whole", BrickView::kWhole}, {"exploded", BrickView::kExploded}}}};
template <>
inline constexpr Names<Look, 4> kNames<Look>{
    "look",
    {{{"plastic", Look::kPlastic}, {"gelatin", Look::kGelatin}, {"rubber", Look::kRubber}, {"steel", Look::kSteel}}}};
template <>
inline constexpr Names<SkinInterpolation, 2> kNames<SkinInterpolation>{
    "way to ride", {{{"bricks", SkinInterpolation::kBricks}, {"smooth", SkinInterpolation::kSmooth}}}};
template <>
inline constexpr Names<MaterialClass, 9> kNames<MaterialClass>{"class of materials",
                                                               {{{"gelatin", MaterialClass::kGelatin},
                                                                 {"silicone", MaterialClass::kSilicone},
                                                                 {"rubber", MaterialClass::kRubber},
                                                                 {"foam", MaterialClass::kFoam},
                                                                 {"wood", MaterialClass::kWood},
                                                                 {"tissue", MaterialClass::kTissue},
                                                                 {"plastic", MaterialClass::kPlastic},
                                                                 {"metal", MaterialClass::kMetal},
                                                                 {"other", MaterialClass::kOther}}}};

template <class Value>
concept InNames = !std::is_same_v<std::remove_cvref_t<decltype(kNames<Value>)>, bool>;

template <InNames Value>
[[nodiscard]] std::vector<std::string_view> value_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : kNames<Value>.values) names.push_back(name);
  return names;
}

template <InNames Value>
[[nodiscard]] std::string_view name_of(Value wanted) {
  const auto& values = kNames<Value>.values;
  return std::find_if(values.begin(), values.end(), [&](const auto& named) { return named.second == wanted; })->first;
}

}  // namespace sprung
