#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/scene/scene_fields.h"

namespace sprung {

/// The names of the values of a type, and what such a value is called in messages.
template <class Value, std::size_t count>
struct Names {
  std::string_view thing;
  std::array<std::pair<std::string_view, Value>, count> values;
};

/// For the types whose values are written as names.
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
inline constexpr Names<StrainEnergyKind, 5> kNames<StrainEnergyKind>{"law", kLawNames};
template <>
inline constexpr Names<Interpolation, 3> kNames<Interpolation>{
    "interpolation",
    {{{"linear", Interpolation::kLinear}, {"smooth", Interpolation::kSmooth}, {"held", Interpolation::kHeld}}}};
template <>
inline constexpr Names<Quality, 4> kNames<Quality>{"quality",
                                                   {{{"preview", Quality::kPreview},
                                                     {"default", Quality::kDefault},
                                                     {"high", Quality::kHigh},
                                                     {"final", Quality::kFinal}}}};
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
inline constexpr Names<LightPreset, 5> kNames<LightPreset>{"light",
                                                           {{{"studio", LightPreset::kStudio},
                                                             {"softbox", LightPreset::kSoftbox},
                                                             {"sunset", LightPreset::kSunset},
                                                             {"overcast", LightPreset::kOvercast},
                                                             {"night", LightPreset::kNight}}}};
template <>
inline constexpr Names<FloorKind, 5> kNames<FloorKind>{"floor",
                                                       {{{"sweep", FloorKind::kSweep},
                                                         {"plain", FloorKind::kPlain},
                                                         {"checker", FloorKind::kChecker},
                                                         {"wood", FloorKind::kWood},
                                                         {"none", FloorKind::kNone}}}};
template <>
inline constexpr Names<RangeOver, 2> kNames<RangeOver>{"range of colours",
                                                       {{{"film", RangeOver::kFilm}, {"frame", RangeOver::kFrame}}}};
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
    "interpolation of the skin", {{{"bricks", SkinInterpolation::kBricks}, {"smooth", SkinInterpolation::kSmooth}}}};
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

/// Throws Error(kBadInput) naming the value and the range if the number is outside it.
void check_range(double value, const KeyInfo& key);

/// "above 0 m and at most 3600 s"; of a key whose numbers are limited.
[[nodiscard]] std::string range_text(const KeyInfo& key);

/// The types whose values are written as names, and those names.
template <class Value>
concept HasNames = InNames<Value> || std::is_same_v<Value, Model>;
template <HasNames Value>
requires std::is_same_v<Value, Model>
[[nodiscard]] std::vector<std::string_view> value_names() { return {model_names().begin(), model_names().end()}; }

/// Throws Error(kBadInput) saying that there is no thing of this name, with the nearest name.
[[noreturn]] void refuse_name(std::string_view thing, std::string_view name,
                              const std::vector<std::string_view>& names);

/// Parses one value as it is typed: quantities with units, names, "#rrggbb", "1280x720".
/// Each throws Error(kBadInput) naming the text and what is expected.
void parse_value(std::string_view text, const KeyInfo& key, double& value);
void parse_value(std::string_view text, const KeyInfo& key, int& value);
void parse_value(std::string_view text, const KeyInfo& key, bool& value);
void parse_value(std::string_view text, const KeyInfo& key, BrickCount& value);
void parse_value(std::string_view text, const KeyInfo& key, std::array<int, 2>& value);
void parse_value(std::string_view text, const KeyInfo& key, std::filesystem::path& value);
void parse_value(std::string_view text, const KeyInfo& key, std::string& value);
void parse_value(std::string_view text, const KeyInfo& key, Axes& value);
void parse_value(std::string_view text, const KeyInfo& key, Model& value);
void parse_value(std::string_view text, const KeyInfo& key, Color& value);

template <InNames Value>
void parse_value(std::string_view text, const KeyInfo&, Value& value) {
  for (const auto& [name, one] : kNames<Value>.values) {
    if (name != text) continue;
    value = one;
    return;
  }
  refuse_name(kNames<Value>.thing, text, value_names<Value>());
}

template <class Value>
requires requires(std::string_view text, const KeyInfo& key, Value& value) { parse_value(text, key, value); }
void parse_value(std::string_view text, const KeyInfo& key, std::optional<Value>& value) {
  parse_value(text, key, value.emplace());
}

/// A type that is written as one word.
template <class Value>
concept Word = requires(std::string_view text, const KeyInfo& key, Value& value) {
  parse_value(text, key, value);
};

/// The value as TOML that reads back as the same value.
[[nodiscard]] std::string toml_text(double value);
[[nodiscard]] std::string toml_text(int value);
[[nodiscard]] std::string toml_text(bool value);
[[nodiscard]] std::string toml_text(const BrickCount& value);
[[nodiscard]] std::string toml_text(const Vec3& value);
[[nodiscard]] std::string toml_text(const std::array<int, 2>& value);
[[nodiscard]] std::string toml_text(const std::array<int, 3>& value);
[[nodiscard]] std::string toml_text(std::string_view value);
[[nodiscard]] std::string toml_text(const std::string& value);
[[nodiscard]] std::string toml_text(const std::filesystem::path& value);
[[nodiscard]] std::string toml_text(const Axes& value);
[[nodiscard]] std::string toml_text(Model value);
[[nodiscard]] std::string toml_text(const Color& value);

template <InNames Value>
[[nodiscard]] std::string toml_text(Value value) {
  return toml_text(name_of(value));
}

template <class Value>
[[nodiscard]] std::string toml_text(const std::vector<Value>& values) {
  std::string text;
  for (const Value& value : values) text += (text.empty() ? "" : ", ") + toml_text(value);
  return "[" + text + "]";
}

}  // namespace sprung
