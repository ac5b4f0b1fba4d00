#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "app/scene/scene_schema.h"
#include "app/scene/scene_tables.h"

namespace sprung {
namespace {

constexpr std::string_view kHead =
    R"(# Keys of a scene

A scene is a TOML file. Lengths, times, pressures, densities, speeds and angles are numbers in the unit named here, or
strings with a unit of their own: "3 cm", "20 kPa", "2 rad/s". Files are relative to the scene file. Tables may be
written as [sections] or in braces.

`sprung help scene` prints this text, `sprung help scene --json-schema` the schema that editors complete and check by.
)";

std::string rule_text(const KeyRule& rule) {
  using Kind = KeyRule::Kind;
  std::vector<std::string> keys;
  for (const std::string_view key : rule.keys) keys.push_back(fmt::format("`{}`", key));
  switch (rule.kind) {
    case Kind::kOneOf:
      return fmt::format("Exactly one of {}.", fmt::join(keys, ", "));
    case Kind::kAnyOf:
      return fmt::format("At least one of {}.", fmt::join(keys, ", "));
    case Kind::kAtMostOne:
      return fmt::format("At most one of {}.", fmt::join(keys, ", "));
    case Kind::kNeeds:
      break;
  }
  return fmt::format("{} only with {}.", keys[0], keys[1]);
}

std::string entry(const KeyText& key) {
  std::string value;
  if (key.required) value = "; required";
  if (!key.default_value.empty()) value = fmt::format("; default {}", key.default_value);
  return fmt::format("- `{}`: {}. *{}{}*\n", key.name, key.help, key.type, value);
}

}  // namespace

std::string scene_reference() {
  std::string text(kHead);
  for (const TableText& table : scene_tables()) {
    std::vector<std::string> paths;
    for (const std::string& path : table.paths) paths.push_back(fmt::format("`{}`", path));
    text += fmt::format("\n## {}\n\n", paths.empty() ? "The scene itself" : fmt::format("{}", fmt::join(paths, ", ")));
    for (const KeyText& key : table.keys) text += entry(key);
    if (table.rules.empty()) continue;
    text += "\n";
    for (const KeyRule& rule : table.rules) text += rule_text(rule) + "\n";
  }
  return text;
}

}  // namespace sprung
