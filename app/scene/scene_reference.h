#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/scene_fields.h"

namespace sprung {

/// A key as documented.
struct KeyText {
  std::string_view name;
  std::string_view help;
  std::string type;           // "number (m), above 0 m", "one of linear, smooth, held"
  std::string default_value;  // as TOML; empty: none
  bool required = false;
  std::string schema;  // of its value, JSON
};

/// A table of a scene: the scene itself, a body, a box ...
struct TableText {
  std::string name;                // unique: "scene", "body"
  std::vector<std::string> paths;  // where it may appear: "[[body]]", "[body.pin.box]"; none for the scene itself
  std::vector<KeyText> keys;
  std::vector<KeyRule> rules;
};

/// Every table that a scene may have, parents before children.
[[nodiscard]] std::vector<TableText> scene_tables();

/// A key of a scene by its path: "body.material.young". Precondition: there is one.
[[nodiscard]] KeyInfo key_at(std::string_view path);

/// A readable reference to every key of a scene: Markdown that reads well as plain text too.
[[nodiscard]] std::string scene_reference();

/// A JSON Schema (2020-12) of scene files, for editors and pipelines: names, types, ranges and the rules between keys.
/// It accepts every scene that parse_scene() accepts. In strings with units it checks only the sign of the number; it
/// does not compare values with each other.
[[nodiscard]] std::string scene_schema();

}  // namespace sprung
