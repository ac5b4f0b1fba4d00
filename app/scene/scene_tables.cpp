#include "app/scene/scene_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "app/console/json_text.h"
#include "app/scene/scene_values.h"

namespace sprung {
namespace {

/// The names of the structs of scene.h that are tables; empty for all else.
template <class Value>
constexpr std::string_view kTableName{};
template <>
constexpr std::string_view kTableName<Film> = "scene";
template <>
constexpr std::string_view kTableName<SceneSolver> = "solver";
template <>
constexpr std::string_view kTableName<GravityKeyframe> = "gravity keyframe";
template <>
constexpr std::string_view kTableName<SceneWind> = "wind";
template <>
constexpr std::string_view kTableName<SceneGlue> = "glue";
template <>
constexpr std::string_view kTableName<Strength> = "strength";
template <>
constexpr std::string_view kTableName<BodyForce> = "force";
template <>
constexpr std::string_view kTableName<BodyMuscle> = "muscle";
template <>
constexpr std::string_view kTableName<SceneCamera> = "camera";
template <>
constexpr std::string_view kTableName<CameraKeyframe> = "camera keyframe";
template <>
constexpr std::string_view kTableName<SceneRender> = "render";
template <>
constexpr std::string_view kTableName<SceneBody> = "body";
template <>
constexpr std::string_view kTableName<Material> = "material";
template <>
constexpr std::string_view kTableName<SphereShape> = "sphere shape";
template <>
constexpr std::string_view kTableName<CylinderShape> = "cylinder shape";
template <>
constexpr std::string_view kTableName<TorusShape> = "torus shape";
template <>
constexpr std::string_view kTableName<Copies> = "copies";
template <>
constexpr std::string_view kTableName<Pin> = "pin";
template <>
constexpr std::string_view kTableName<Keyframe> = "keyframe";
template <>
constexpr std::string_view kTableName<Region> = "region";
template <>
constexpr std::string_view kTableName<Gradient> = "gradient";
template <>
constexpr std::string_view kTableName<Cut> = "cut";
template <>
constexpr std::string_view kTableName<Box> = "box";
template <>
constexpr std::string_view kTableName<Ball> = "ball";
template <>
constexpr std::string_view kTableName<HalfSpace> = "half-space";
template <>
constexpr std::string_view kTableName<SceneObstacle> = "obstacle";
template <>
constexpr std::string_view kTableName<CapsuleShape> = "capsule shape";
template <>
constexpr std::string_view kTableName<SceneContact> = "contact";
template <>
constexpr std::string_view kTableName<Plane> = "plane";
template <>
constexpr std::string_view kTableName<Probe> = "probe";
template <>
constexpr std::string_view kTableName<Experiment> = "experiment";
template <>
constexpr std::string_view kTableName<Expectation> = "expectation";
template <>
constexpr std::string_view kTableName<Gate> = "gate";

template <class Value>
concept Table = !kTableName<Value>.empty();

struct Described {
  std::string type;
  std::string schema;
};

std::string bounds(const Range& range) {
  std::string text;
  if (std::isfinite(range.low)) {
    text += fmt::format(R"(, "{}": {})", range.without_low ? "exclusiveMinimum" : "minimum", range.low);
  }
  if (std::isfinite(range.high)) {
    text += fmt::format(R"(, "{}": {})", range.without_high ? "exclusiveMaximum" : "maximum", range.high);
  }
  return text;
}

/// ", above 0 m": nothing where all numbers do.
std::string range_suffix(const KeyInfo& key) {
  const bool is_limited = std::isfinite(key.range.low) || std::isfinite(key.range.high);
  return is_limited ? fmt::format(", {}", range_text(key)) : "";
}

/// A string with a number and a unit; of the range it knows the sign only.
std::string quantity_pattern(const KeyInfo& key) {
  static const std::regex kSpecial(R"([.^$*+?()\[\]{}|\\])");
  std::string units;
  for (const std::string_view unit : units_of(key.dimension)) {
    if (!units.empty()) units += '|';
    units += std::regex_replace(std::string(unit), kSpecial, R"(\$&)");
  }
  return fmt::format(R"(^\s*{}([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*({})?\s*$)",
                     key.range.low >= 0 ? "[+]?" : "[-+]?", units);
}

Described number(const KeyInfo& key, const std::string& noun = "number") {
  const std::string_view unit = base_unit(key.dimension);
  return {fmt::format("{}{}{}", noun, unit.empty() ? "" : fmt::format(" ({})", unit), range_suffix(key)),
          fmt::format(R"({{"anyOf": [{{"type": "number"{}}}, {{"type": "string", "pattern": {}}}]}})",
                      bounds(key.range), json_text(std::string_view(quantity_pattern(key))))};
}

Described whole_number(const KeyInfo& key, const std::string& noun = "whole number") {
  if (!key.choices.empty()) {
    return {fmt::format("one of {}", fmt::join(key.choices, ", ")),
            fmt::format(R"({{"enum": [{}]}})", fmt::join(key.choices, ", "))};
  }
  return {noun + range_suffix(key), fmt::format(R"({{"type": "integer"{}}})", bounds(key.range))};
}

Described array_of(const Described& item, std::size_t count) {
  return {item.type,
          fmt::format(R"({{"type": "array", "minItems": {0}, "maxItems": {0}, "items": {1}}})", count, item.schema)};
}

Described name_among(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + json_text(name);
  return {fmt::format("one of {}", fmt::join(names, ", ")), fmt::format(R"({{"enum": [{}]}})", list)};
}

Described text_like(std::string_view type, std::string_view pattern) {
  return {std::string(type), fmt::format(R"({{"type": "string", "pattern": {}}})", json_text(pattern))};
}

std::string reference(std::string_view table) { return fmt::format(R"({{"$ref": "#/$defs/{}"}})", table); }

/// What a value of that type may be. The argument only names the type.
Described describe(const double&, const KeyInfo& key) { return number(key); }
Described describe(const int&, const KeyInfo& key) { return whole_number(key); }
Described describe(const bool&, const KeyInfo&) { return {"true or false", R"({"type": "boolean"})"}; }
Described describe(const BrickCount&, const KeyInfo& key) {
  const Described count = whole_number(key);
  return {count.type + ", or \"auto\"",
          fmt::format(R"({{"anyOf": [{}, {{"type": "string", "pattern": "^(auto|[0-9]+)$"}}]}})", count.schema)};
}
Described describe(const Vec3&, const KeyInfo& key) { return array_of(number(key, "3 numbers"), 3); }
template <std::size_t count>
Described describe(const std::array<int, count>&, const KeyInfo& key) {
  return array_of(whole_number(key, fmt::format("{} whole numbers", count)), count);
}
Described describe(const std::string&, const KeyInfo&) { return text_like("text", "."); }
Described describe(const std::filesystem::path&, const KeyInfo&) { return text_like("file", "."); }
Described describe(const Axes&, const KeyInfo&) { return text_like("some of \"xyz\"", "^(?!.*(.).*\\1)[xyz]+$"); }
Described describe(const Color&, const KeyInfo&) { return text_like("\"#rrggbb\"", "^#[0-9a-fA-F]{6}$"); }
Described describe(const Material&, const KeyInfo&) {
  std::vector<std::string_view> names;
  for (const LibraryMaterial& known : built_in_materials()->materials()) names.push_back(known.name);
  return {"name, or table", fmt::format(R"({{"anyOf": [{}, {{"type": "string", "pattern": "."}}, {}]}})",
                                        name_among(names).schema, reference(kTableName<Material>))};
}
template <HasNames Value>
Described describe(const Value&, const KeyInfo&) {
  return name_among(value_names<Value>());
}
template <Table Value>
Described describe(const Value&, const KeyInfo&) {
  return {"table", reference(kTableName<Value>)};
}
template <class Value>
Described describe(const std::optional<Value>&, const KeyInfo& key) {
  return describe(Value{}, key);
}
template <class Value>
Described describe(const std::vector<Value>&, const KeyInfo& key) {
  const Described item = describe(Value{}, key);
  return {Table<Value> ? "tables" : fmt::format("list: {}", item.type),
          fmt::format(R"({{"type": "array", "items": {}}})", item.schema)};
}

/// As TOML; empty where the value is left out or is a table.
template <class Value>
std::string default_of(const Value& value) {
  if constexpr (requires { value.empty(); }) {
    if (value.empty()) return "";
  }
  if constexpr (requires { toml_text(value); }) return toml_text(value);
  return "";
}
template <class Value>
std::string default_of(const std::optional<Value>&) {
  return "";
}
template <class Value>
std::string default_of(const std::vector<Value>&) {
  return "";
}
template <>
std::string default_of(const Material& material) {
  return material.name.empty() ? "" : toml_text(std::string_view(material.name));
}

template <class Value>
struct ElementOf {
  using Type = Value;
  static constexpr bool kIsList = false;
};
template <class Value>
struct ElementOf<std::optional<Value>> : ElementOf<Value> {};
template <class Value>
struct ElementOf<std::vector<Value>> {
  using Type = Value;
  static constexpr bool kIsList = true;
};

class Walk {
 public:
  template <class Owner>
  void visit(const std::string& path, bool is_list) {
    const std::size_t row = row_of(kTableName<Owner>);
    if (!path.empty()) tables_[row].paths.push_back(is_list ? fmt::format("[[{}]]", path) : fmt::format("[{}]", path));
    const bool is_new = tables_[row].keys.empty();
    tables_[row].rules = rules<Owner>();
    const Owner fresh = default_owner<Owner>();
    for (const Key<Owner>& key : keys<Owner>()) {
      std::visit([&](auto field) { add(row, is_new, key, fresh.*field); }, key.member);
    }
    for (const Key<Owner>& key : keys<Owner>()) {
      const std::string below = path.empty() ? std::string(key.name) : fmt::format("{}.{}", path, key.name);
      std::visit([&](auto field) { visit_below(below, fresh.*field); }, key.member);
    }
  }

  [[nodiscard]] std::vector<TableText> tables() && { return std::move(tables_); }

 private:
  std::size_t row_of(std::string_view name) {
    const auto is_it = [&](const TableText& table) { return table.name == name; };
    const auto found = std::find_if(tables_.begin(), tables_.end(), is_it);
    const std::size_t row = found - tables_.begin();
    if (found == tables_.end()) tables_.emplace_back().name = name;
    return row;
  }

  template <class Value>
  void add(std::size_t row, bool is_new, const KeyInfo& key, const Value& value) {
    if (!is_new) return;
    const Described described = describe(value, key);
    tables_[row].keys.push_back({.name = key.name,
                                 .help = key.help,
                                 .type = described.type,
                                 .default_value = key.required ? "" : default_of(value),
                                 .required = key.required,
                                 .schema = described.schema});
  }

  template <class Value>
  void visit_below(const std::string& path, const Value&) {
    using Element = ElementOf<Value>;
    if constexpr (Table<typename Element::Type>) visit<typename Element::Type>(path, Element::kIsList);
  }

  std::vector<TableText> tables_;
};

}  // namespace

std::vector<TableText> scene_tables() {
  Walk walk;
  walk.visit<Film>("", false);
  return std::move(walk).tables();
}

}  // namespace sprung
