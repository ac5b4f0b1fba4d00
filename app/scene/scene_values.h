#pragma once
#include <string>
#include <string_view>

#include "app/scene/named_values.h"
#include "app/scene/scene_keys.h"

namespace sprung {

/// Throws Error(kBadInput) naming the value and the range where the number is outside it.
void check_range(double value, const KeyInfo& key);

/// "above 0 m and at most 3600 s"; of a key whose numbers are limited.
[[nodiscard]] std::string range_text(const KeyInfo& key);

/// The types whose values are written as names, and those names.
template <class Value>
concept HasNames = InNames<Value> || std::is_same_v<Value, Model>;
template <HasNames Value>
requires std::is_same_v<Value, Model>
[[nodiscard]] std::vector<std::string_view> value_names() { return {model_names().begin(), model_names().end()}; }

/// Throws Error(kBadInput) that there is no such thing of this name, with the nearest that there is.
[[noreturn]] void refuse_name(std::string_view thing, std::string_view name,
                              const std::vector<std::string_view>& names);

/// One value from the words of a person: quantities with units, names, "#rrggbb", "1280x720".
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
