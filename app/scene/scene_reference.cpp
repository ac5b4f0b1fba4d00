#include "app/scene/scene_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/scene/scene_values.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

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

/// The name and the rules of a table.
struct TableHead {
  std::string name;
  std::vector<KeyRule> rules;

  void table(std::string_view table_name, const std::vector<KeyRule>& table_rules = {}) {
    name = table_name;
    rules = table_rules;
  }
  template <class Value>
  void operator()(const KeyInfo&, const Value&) {}
};

template <Table Owner>
TableHead head_of() {
  TableHead head;
  const Owner owner{};
  fields(head, owner);
  return head;
}

/// The type of a value, in words and as a JSON Schema.
struct Described {
  std::string type;
  Json schema;
};

void add_bounds(Json& schema, const Range& range) {
  const auto number = [](double value) { return value == std::floor(value) ? Json(long(value)) : Json(value); };
  if (std::isfinite(range.low)) schema[range.without_low ? "exclusiveMinimum" : "minimum"] = number(range.low);
  if (std::isfinite(range.high)) schema[range.without_high ? "exclusiveMaximum" : "maximum"] = number(range.high);
}

/// ", above 0 m"; nothing if all numbers are allowed.
std::string range_suffix(const KeyInfo& key) {
  const bool is_limited = std::isfinite(key.range.low) || std::isfinite(key.range.high);
  return is_limited ? fmt::format(", {}", range_text(key)) : "";
}

/// A regular expression for a number with a unit; of the range it checks the sign only.
std::string quantity_pattern(const KeyInfo& key) {
  static const std::regex kSpecial(R"([.^$*+?()\[\]{}|\\])");
  std::vector<std::string> units;
  for (const std::string_view unit : units_of(key.dimension)) {
    units.push_back(std::regex_replace(std::string(unit), kSpecial, R"(\$&)"));
  }
  return fmt::format(R"(^\s*{}([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*({})?\s*$)",
                     key.range.low >= 0 ? "[+]?" : "[-+]?", fmt::join(units, "|"));
}

Json text_schema(std::string_view pattern) { return {{"type", "string"}, {"pattern", pattern}}; }

Described number(const KeyInfo& key, const std::string& noun = "number") {
  const std::string_view unit = base_unit(key.dimension);
  Json bare{{"type", "number"}};
  add_bounds(bare, key.range);
  return {fmt::format("{}{}{}", noun, unit.empty() ? "" : fmt::format(" ({})", unit), range_suffix(key)),
          {{"anyOf", {bare, text_schema(quantity_pattern(key))}}}};
}

Described whole_number(const KeyInfo& key, const std::string& noun = "whole number") {
  if (!key.choices.empty()) {
    return {fmt::format("one of {}", fmt::join(key.choices, ", ")),
            {{"enum", std::vector<int>(key.choices.begin(), key.choices.end())}}};
  }
  Json schema{{"type", "integer"}};
  add_bounds(schema, key.range);
  return {noun + range_suffix(key), schema};
}

Described array_of(const Described& item, std::size_t count) {
  return {item.type, {{"type", "array"}, {"minItems", count}, {"maxItems", count}, {"items", item.schema}}};
}

Described name_among(const std::vector<std::string_view>& names) {
  return {fmt::format("one of {}", fmt::join(names, ", ")), {{"enum", names}}};
}

template <Table Owner>
Json reference() {
  return {{"$ref", "#/$defs/" + head_of<Owner>().name}};
}

/// The first argument only selects the type.
Described describe(const double&, const KeyInfo& key) { return number(key); }
Described describe(const int&, const KeyInfo& key) { return whole_number(key); }
Described describe(const bool&, const KeyInfo&) { return {"true or false", {{"type", "boolean"}}}; }
Described describe(const BrickCount&, const KeyInfo& key) {
  const Described count = whole_number(key);
  return {count.type + ", or \"auto\"", {{"anyOf", {count.schema, text_schema("^(auto|[0-9]+)$")}}}};
}
Described describe(const Vec3&, const KeyInfo& key) { return array_of(number(key, "3 numbers"), 3); }
template <std::size_t count>
Described describe(const std::array<int, count>&, const KeyInfo& key) {
  return array_of(whole_number(key, fmt::format("{} whole numbers", count)), count);
}
Described describe(const std::string&, const KeyInfo&) { return {"text", text_schema(".")}; }
Described describe(const std::filesystem::path&, const KeyInfo&) { return {"file", text_schema(".")}; }
Described describe(const Axes&, const KeyInfo&) { return {"some of \"xyz\"", text_schema("^(?!.*(.).*\\1)[xyz]+$")}; }
Described describe(const Color&, const KeyInfo&) { return {"\"#rrggbb\"", text_schema("^#[0-9a-fA-F]{6}$")}; }
Described describe(const Material&, const KeyInfo&) {
  std::vector<std::string_view> names;
  for (const LibraryMaterial& known : built_in_materials()->materials()) names.push_back(known.name);
  return {"name, or table", {{"anyOf", {name_among(names).schema, text_schema("."), reference<Material>()}}}};
}
template <HasNames Value>
Described describe(const Value&, const KeyInfo&) {
  return name_among(value_names<Value>());
}
template <Table Value>
Described describe(const Value&, const KeyInfo&) {
  return {"table", reference<Value>()};
}
template <class Value>
Described describe(const std::optional<Value>&, const KeyInfo& key) {
  return describe(Value{}, key);
}
template <class Value>
Described describe(const std::vector<Value>&, const KeyInfo& key) {
  const Described item = describe(Value{}, key);
  return {Table<Value> ? "tables" : fmt::format("list: {}", item.type), {{"type", "array"}, {"items", item.schema}}};
}

/// As TOML; empty if the value is left out or is a table.
template <class Value>
std::string default_text(const Value& value) {
  if constexpr (std::is_same_v<Value, Material>) return value.name.empty() ? "" : toml_text(value.name);
  if constexpr (requires { value.empty(); }) {
    if (value.empty()) return "";
  }
  if constexpr (requires { toml_text(value); }) return toml_text(value);
  return "";
}
template <class Value>
std::string default_text(const std::optional<Value>&) {
  return "";
}
template <class Value>
std::string default_text(const std::vector<Value>&) {
  return "";
}

/// Returns whether one of several keys has to be given: what it is without being given then means nothing.
bool is_alternative(std::string_view key, const std::vector<KeyRule>& rules) {
  return std::any_of(rules.begin(), rules.end(), [&](const KeyRule& rule) {
    return rule.relation == KeyRule::kOneOf && std::find(rule.keys.begin(), rule.keys.end(), key) != rule.keys.end();
  });
}

/// Collects all tables below the scene, each once but with all its paths.
class TableCollector {
 public:
  template <Table Owner>
  void collect(const std::string& path, bool is_list) {
    const TableHead head = head_of<Owner>();
    const auto found =
        std::find_if(tables.begin(), tables.end(), [&](const TableText& table) { return table.name == head.name; });
    const std::size_t row = found - tables.begin();
    if (found == tables.end()) tables.push_back({.name = head.name, .paths = {}, .keys = {}, .rules = head.rules});
    if (!path.empty()) tables[row].paths.push_back(is_list ? fmt::format("[[{}]]", path) : fmt::format("[{}]", path));
    const Owner owner = default_table<Owner>();
    if (tables[row].keys.empty()) {
      KeyCollector keys{{}, tables[row].keys};
      fields(keys, owner);
      for (KeyText& key : tables[row].keys) {
        if (is_alternative(key.name, head.rules)) key.default_value.clear();
      }
    }
    ChildCollector children{{}, *this, path.empty() ? "" : path + "."};
    fields(children, owner);
  }

  std::vector<TableText> tables;

 private:
  struct KeyCollector : FieldVisitor {
    std::vector<KeyText>& keys;

    template <class Value>
    void operator()(const KeyInfo& key, const Value& value) {
      const Described described = describe(value, key);
      keys.push_back({.name = key.name,
                      .help = key.help,
                      .type = described.type,
                      .default_value = key.required ? "" : default_text(value),
                      .required = key.required,
                      .schema = described.schema.dump()});
    }
  };

  struct ChildCollector : FieldVisitor {
    TableCollector& tables;
    std::string path;

    template <class Value>
    void operator()(const KeyInfo& key, const Value&) {
      using Element = ElementOf<Value>;
      if constexpr (Table<typename Element::Type>) {
        tables.template collect<typename Element::Type>(path + std::string(key.name), Element::kIsList);
      }
    }
  };
};

struct KeyFinder : FieldVisitor {
  std::string_view path;
  KeyInfo found{};

  template <class Value>
  void operator()(const KeyInfo& key, const Value&) {
    using Element = typename ElementOf<Value>::Type;
    const auto dot = path.find('.');
    if (key.name != path.substr(0, dot)) return;
    if (dot == std::string_view::npos) {
      found = key;
    } else if constexpr (Table<Element>) {
      KeyFinder below{{}, path.substr(dot + 1)};
      const Element element{};
      fields(below, element);
      found = below.found;
    }
  }
};

constexpr std::string_view kHead =
    R"(# Keys of a scene

A scene is a TOML file. Lengths, times, pressures, densities, speeds and angles are numbers in the unit named here, or
strings with a unit of their own: "3 cm", "20 kPa", "2 rad/s". Files are relative to the scene file. Tables may be
written as [sections] or in braces.

`sprung help scene` prints this text, `sprung help scene --json-schema` the schema that editors complete and check by.
)";

std::string rule_text(const KeyRule& rule) {
  std::vector<std::string> keys;
  for (const std::string_view key : rule.keys) keys.push_back(fmt::format("`{}`", key));
  switch (rule.relation) {
    case KeyRule::kOneOf:
      return fmt::format("Exactly one of {}.", fmt::join(keys, ", "));
    case KeyRule::kAnyOf:
      return fmt::format("At least one of {}.", fmt::join(keys, ", "));
    case KeyRule::kAtMostOne:
      return fmt::format("At most one of {}.", fmt::join(keys, ", "));
    case KeyRule::kNeeds:
      break;
  }
  return fmt::format("{} only with {}.", keys[0], keys[1]);
}

/// Members of the "allOf" of a table.
std::vector<Json> rule_schemas(const KeyRule& rule) {
  const auto required_keys = [](const std::vector<std::string_view>& keys) { return Json{{"required", keys}}; };
  if (rule.relation == KeyRule::kNeeds) {
    return {{{"dependentRequired", {{std::string(rule.keys[0]), Json::array({rule.keys[1]})}}}}};
  }
  std::vector<Json> schemas;
  if (rule.relation == KeyRule::kAtMostOne) {
    for (std::size_t i = 0; i < rule.keys.size(); ++i) {
      for (std::size_t j = i + 1; j < rule.keys.size(); ++j) {
        schemas.push_back({{"not", required_keys({rule.keys[i], rule.keys[j]})}});
      }
    }
    return schemas;
  }
  for (const std::string_view key : rule.keys) schemas.push_back(required_keys({key}));
  return {{{rule.relation == KeyRule::kOneOf ? "oneOf" : "anyOf", schemas}}};
}

Json table_schema(const TableText& table) {
  Json schema{{"type", "object"}, {"additionalProperties", false}};
  for (const KeyText& key : table.keys) {
    if (key.required) schema["required"].push_back(key.name);
  }
  for (const KeyRule& rule : table.rules) {
    for (Json& one : rule_schemas(rule)) schema["allOf"].push_back(std::move(one));
  }
  for (const KeyText& key : table.keys) {
    Json& property = schema["properties"][std::string(key.name)];
    property["description"] = key.help;
    property.update(Json::parse(key.schema));
  }
  return schema;
}

}  // namespace

std::vector<TableText> scene_tables() {
  TableCollector collector;
  collector.collect<Film>("", false);
  return std::move(collector.tables);
}

KeyInfo key_at(std::string_view path) {
  KeyFinder finder{{}, path};
  const Film film;
  fields(finder, film);
  return finder.found;
}

std::string scene_reference() {
  std::string text(kHead);
  for (const TableText& table : scene_tables()) {
    text += fmt::format("\n## {}\n\n",
                        table.paths.empty() ? "The scene itself" : fmt::format("`{}`", fmt::join(table.paths, "`, `")));
    for (const KeyText& key : table.keys) {
      std::string value;
      if (key.required) value = "; required";
      if (!key.default_value.empty()) value = fmt::format("; default {}", key.default_value);
      text += fmt::format("- `{}`: {}. *{}{}*\n", key.name, key.help, key.type, value);
    }
    if (!table.rules.empty()) text += "\n";
    for (const KeyRule& rule : table.rules) text += rule_text(rule) + "\n";
  }
  return text;
}

std::string scene_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "A scene of sprung"},
              {"$ref", "#/$defs/scene"}};
  for (const TableText& table : scene_tables()) schema["$defs"][table.name] = table_schema(table);
  return schema.dump(1) + "\n";
}

}  // namespace sprung
