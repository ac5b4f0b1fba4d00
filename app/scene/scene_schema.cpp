#include "app/scene/scene_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "app/console/json_text.h"
#include "app/scene/scene_tables.h"

namespace sprung {
namespace {

std::string names_of(const std::vector<std::string_view>& keys) {
  std::string list;
  for (const std::string_view key : keys) list += (list.empty() ? "" : ", ") + json_text(key);
  return list;
}

std::string required(std::string_view key) { return fmt::format(R"({{"required": [{}]}})", json_text(key)); }

/// Members of the "allOf" of a table.
std::vector<std::string> schemas_of(const KeyRule& rule) {
  using Kind = KeyRule::Kind;
  if (rule.kind == Kind::kNeeds) {
    return {fmt::format(R"({{"dependentRequired": {{{}: [{}]}}}})", json_text(rule.keys[0]), json_text(rule.keys[1]))};
  }
  if (rule.kind != Kind::kAtMostOne) {
    std::string list;
    for (const std::string_view key : rule.keys) list += (list.empty() ? "" : ", ") + required(key);
    return {fmt::format(R"({{"{}": [{}]}})", rule.kind == Kind::kOneOf ? "oneOf" : "anyOf", list)};
  }
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < rule.keys.size(); ++i) {
    for (std::size_t j = i + 1; j < rule.keys.size(); ++j) {
      pairs.push_back(fmt::format(R"({{"not": {{"required": [{}]}}}})", names_of({rule.keys[i], rule.keys[j]})));
    }
  }
  return pairs;
}

/// `schema` with the text as its description.
std::string described(const std::string& schema, std::string_view text) {
  return fmt::format(R"({{"description": {}, {})", json_text(text), schema.substr(1));
}

std::string schema_of(const TableText& table) {
  std::vector<std::string> properties;
  std::vector<std::string_view> needed;
  std::vector<std::string> all;
  for (const KeyText& key : table.keys) {
    properties.push_back(fmt::format("        {}: {}", json_text(key.name), described(key.schema, key.help)));
    if (key.required) needed.push_back(key.name);
  }
  for (const KeyRule& rule : table.rules) {
    for (const std::string& schema : schemas_of(rule)) all.push_back("        " + schema);
  }
  std::string text = fmt::format("    {}: {{\n      \"type\": \"object\",\n      \"additionalProperties\": false,\n",
                                 json_text(std::string_view(table.name)));
  if (!needed.empty()) text += fmt::format("      \"required\": [{}],\n", names_of(needed));
  if (!all.empty()) text += fmt::format("      \"allOf\": [\n{}\n      ],\n", fmt::join(all, ",\n"));
  return text + fmt::format("      \"properties\": {{\n{}\n      }}\n    }}", fmt::join(properties, ",\n"));
}

}  // namespace

std::string scene_schema() {
  std::vector<std::string> definitions;
  for (const TableText& table : scene_tables()) definitions.push_back(schema_of(table));
  return fmt::format(R"({{
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "A scene of sprung",
  "$ref": "#/$defs/scene",
  "$defs": {{
{}
  }}
}}
)",
                     fmt::join(definitions, ",\n"));
}

}  // namespace sprung
