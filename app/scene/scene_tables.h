#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/scene_keys.h"

namespace sprung {

/// What a person and a checker have to know of a key.
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
  std::vector<std::string> paths;  // where it may stand: "[[body]]", "[body.pin.box]"; none for the scene itself
  std::vector<KeyText> keys;
  std::span<const KeyRule> rules;
};

/// Every table that a scene may have, parents before children: scene_keys.h as texts.
[[nodiscard]] std::vector<TableText> scene_tables();

}  // namespace sprung
