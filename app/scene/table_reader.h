#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/material_library.h"
#include "app/scene/scene_checks.h"
#include "app/scene/scene_file.h"
#include "app/scene/scene_mistakes.h"
#include "app/scene/scene_values.h"
#include "app/scene/toml.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sprung {

/// The text as TOML. Throws Error(kBadInput) with the place of what is none.
[[nodiscard]] toml::table parse_toml(std::string_view text, SceneMistakes& mistakes);

/// For messages.
[[nodiscard]] std::string kind_of(const toml::node& node);
/// What is written as one word.
template <class Value>
concept Word = requires(std::string_view text, const KeyInfo& key, Value& value) {
  parse_value(text, key, value);
};

/// Reads tables into the structs of scene.h by the table of keys.
class TableReader {
 public:
  /// `library`: the materials that are known by name. All but the folder have to outlive it.
  TableReader(SceneMistakes& mistakes, std::filesystem::path folder, SceneFiles files, const MaterialLibrary& library)
      : mistakes_(mistakes), folder_(std::move(folder)), files_(files), library_(library) {}

  template <class Owner>
  void read(const toml::table& table, const std::string& path, Owner& owner) {
    for (const auto& [name, node] : table) read_entry(name, node, path, owner);
    for (const Key<Owner>& key : keys<Owner>()) {
      if (key.required && !table.contains(key.name)) {
        const std::string where = path.empty() ? "the scene" : path;
        mistakes_.add(table.source(), fmt::format("{} lacks the key '{}': {}", where, key.name, key.help));
      }
    }
    check_rules(table, path, rules<Owner>(), mistakes_);
    check_together(table, path, owner, mistakes_);
  }

 private:
  template <class Owner>
  void read_entry(const toml::key& name, const toml::node& node, const std::string& path, Owner& owner) {
    const std::string full = path.empty() ? std::string(name.str()) : fmt::format("{}.{}", path, name.str());
    const Key<Owner>* key = find_key<Owner>(name.str());
    if (key == nullptr) {
      const std::string hint = did_you_mean(name.str(), key_names<Owner>());
      mistakes_.add(name.source(), fmt::format("unknown key '{}'{}", full, hint));
      return;
    }
    std::visit([&](auto field) { try_value(node, full, *key, owner.*field); }, key->member);
  }

  template <class Value>
  void try_value(const toml::node& node, const std::string& path, const KeyInfo& key, Value& value) {
    try {
      value_of(node, path, key, value);
    } catch (const Error& error) {
      mistakes_.add(node.source(), fmt::format("{}: {}", path, error.what()));
    }
  }

  [[noreturn]] static void refuse_type(const toml::node& node, std::string_view expected) {
    throw Error(ErrorKind::kBadInput, fmt::format("must be {}, not {}", expected, kind_of(node)));
  }

  static const toml::array& array_of(const toml::node& node, std::size_t size, std::string_view expected) {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != size) refuse_type(node, expected);
    return *array;
  }

  static void value_of(const toml::node& node, const std::string&, const KeyInfo& key, double& value) {
    if (const auto* text = node.as_string()) return parse_value(text->get(), key, value);
    const bool takes_unit = key.dimension != Dimension::kNone;
    if (!node.is_number()) refuse_type(node, takes_unit ? "a number or a string with a unit" : "a number");
    value = *node.value<double>();
    check_range(value, key);
  }

  static void value_of(const toml::node& node, const std::string&, const KeyInfo&, bool& value) {
    const auto* truth = node.as_boolean();
    if (truth == nullptr) refuse_type(node, "true or false");
    value = truth->get();
  }

  static void value_of(const toml::node& node, const std::string&, const KeyInfo& key, int& value) {
    const auto* number = node.as_integer();
    if (number == nullptr) refuse_type(node, "a whole number");
    check_range(double(number->get()), key);
    value = int(number->get());
  }

  static void value_of(const toml::node& node, const std::string& path, const KeyInfo& key, BrickCount& value) {
    if (const auto* text = node.as_string()) return parse_value(text->get(), key, value);
    value_of(node, path, key, value.along);
  }

  void value_of(const toml::node& node, const std::string& path, const KeyInfo& key, Vec3& value) {
    const toml::array& array = array_of(node, 3, "an array of 3 numbers");
    for (int i = 0; i < 3; ++i) try_value(array[i], fmt::format("{}[{}]", path, i), key, value[i]);
  }

  template <std::size_t count>
  void value_of(const toml::node& node, const std::string& path, const KeyInfo& key, std::array<int, count>& value) {
    const toml::array& array = array_of(node, count, fmt::format("an array of {} whole numbers", count));
    for (std::size_t i = 0; i < count; ++i) try_value(array[i], fmt::format("{}[{}]", path, i), key, value[i]);
  }

  void value_of(const toml::node& node, const std::string&, const KeyInfo& key, std::filesystem::path& value) {
    const auto* text = node.as_string();
    if (text == nullptr) refuse_type(node, "a string");
    parse_value(text->get(), key, value);
    value = std::filesystem::absolute(folder_ / value).lexically_normal();
    if (files_ == SceneFiles::kPresent) check_readable(value);
  }

  void value_of(const toml::node& node, const std::string& path, const KeyInfo&, Material& value) {
    if (const auto* text = node.as_string()) {
      value = library_.find(text->get()).material();
      return;
    }
    if (!node.is_table()) refuse_type(node, "the name of a material or a table");
    value = Material{};
    read(*node.as_table(), path, value);
  }

  template <class Value>
  void value_of(const toml::node& node, const std::string& path, const KeyInfo& key, std::optional<Value>& value) {
    Value read{};
    value_of(node, path, key, read);
    value = std::move(read);
  }

  /// Solver, Model, Axes, Color, names.
  template <Word Value>
  void value_of(const toml::node& node, const std::string&, const KeyInfo& key, Value& value) {
    const auto* text = node.as_string();
    if (text == nullptr) refuse_type(node, "a string");
    parse_value(text->get(), key, value);
  }

  /// Box, Plane, camera, render: tables.
  template <class Owner>
  requires(!Word<Owner>) void value_of(const toml::node& node, const std::string& path, const KeyInfo&, Owner& value) {
    if (!node.is_table()) refuse_type(node, "a table");
    read(*node.as_table(), path, value);
  }

  template <Word Value>
  void value_of(const toml::node& node, const std::string& path, const KeyInfo& key, std::vector<Value>& values) {
    const toml::array* array = node.as_array();
    if (array == nullptr) refuse_type(node, "an array");
    values.resize(array->size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      try_value((*array)[i], fmt::format("{}[{}]", path, i), key, values[i]);
    }
  }

  template <class Owner>
  requires(!Word<Owner>) void value_of(const toml::node& node, const std::string& path, const KeyInfo& key,
                                       std::vector<Owner>& values) {
    const toml::array* array = node.as_array();
    if (array == nullptr || !array->is_array_of_tables()) {
      refuse_type(node, fmt::format("written as [[{}]]", path));
    }
    for (const toml::node& element : *array) value_of(element, path, key, values.emplace_back(default_owner<Owner>()));
  }

  SceneMistakes& mistakes_;
  std::filesystem::path folder_;
  SceneFiles files_;
  const MaterialLibrary& library_;
};

}  // namespace sprung
