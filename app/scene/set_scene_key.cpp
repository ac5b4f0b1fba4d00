#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "app/scene/scene_file.h"
#include "app/scene/scene_reference.h"
#include "app/scene/scene_values.h"
#include "app/scene/tension_curve.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sprung {
namespace {

/// The value to which a key is set.
struct Given {
  std::string_view text;
  const MaterialLibrary& library;
  const KeyIsGiven& is_given;
};

[[noreturn]] void refuse(std::string_view path) {
  throw Error(ErrorKind::kBadInput, fmt::format("the key '{}' cannot be set by itself", path));
}

template <Table Owner>
void set_key(Owner& owner, std::string_view path, const Given& given);

/// The items of "[1, 2, 3]", with or without brackets.
std::vector<std::string_view> items_of(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  std::vector<std::string_view> items;
  while (true) {
    const auto comma = text.find(',');
    items.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return items;
    text = text.substr(comma + 1);
  }
}

template <class Value>
void set_value(Value& value, const KeyInfo& key, std::string_view rest, const Given& given);

/// Three numbers.
template <class Values>
void set_items(Values& values, const KeyInfo& key, const Given& given) {
  const std::vector<std::string_view> items = items_of(given.text);
  if (items.size() != 3) throw Error(ErrorKind::kBadInput, "must be 3 numbers: [1, 2, 3]");
  for (std::size_t i = 0; i < 3; ++i) parse_value(items[i], key, values[i]);
}

template <class Value>
void set_value(std::optional<Value>& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  if constexpr (Table<Value>) {
    if (!value) refuse(key.name);
    set_key(*value, rest, given);
  } else {
    set_value(value.emplace(), key, rest, given);
  }
}

template <class Value>
void set_value(std::vector<Value>& values, const KeyInfo& key, std::string_view rest, const Given& given) {
  if constexpr (Table<Value>) {
    if (rest.empty() && given.text != "[]") refuse(key.name);
    if (rest.empty()) values.clear();
    for (Value& value : values) set_key(value, rest, given);
  } else {
    if (!rest.empty()) refuse(rest);
    values.clear();
    for (const std::string_view item : items_of(given.text)) parse_value(item, key, values.emplace_back());
  }
}

void set_value(Material& material, const KeyInfo&, std::string_view rest, const Given& given) {
  if (rest.empty()) {
    material = given.library.named(given.text);
    return;
  }
  if (rest == "poisson") material.poisson_in_motion.reset();
  set_key(material, rest, given);
  material.name = "custom";
  material.source.clear();
  if (!material.curve.empty()) fit_to_curve(material, material.law.kind != StrainEnergyKind::kNeoHooke);
  material.curve.clear();
}

/// `rest`: the path below the key; empty unless the value is a table.
template <class Value>
void set_value(Value& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  if constexpr (Table<Value>) {
    set_key(value, rest, given);
    return;
  } else {
    if (!rest.empty()) refuse(rest);
    if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, std::array<int, 3>>) {
      set_items(value, key, given);
    } else {
      parse_value(given.text, key, value);
    }
    if constexpr (std::is_same_v<Value, std::filesystem::path>) {
      // Relative to the working folder; a scene file's own paths are relative to its folder.
      value = std::filesystem::absolute(value).lexically_normal();
      check_readable(value);
    }
  }
}

/// "; did you mean 'body.material.young'?" if a key of nearly that name is in another table; at most three.
std::string did_you_mean_elsewhere(std::string_view name) {
  const std::vector<TableText> tables = scene_tables();
  std::vector<std::string_view> names;
  for (const TableText& table : tables) {
    if (table.paths.empty()) continue;
    for (const KeyText& key : table.keys) names.push_back(key.name);
  }
  const std::string_view nearest = nearest_word(name, names);
  std::vector<std::string> paths;
  for (const TableText& table : tables) {
    const bool has_it = std::any_of(table.keys.begin(), table.keys.end(),
                                    [&](const KeyText& key) { return !nearest.empty() && key.name == nearest; });
    if (!has_it || table.paths.empty() || paths.size() == 3) continue;
    const std::string& header = table.paths.front();
    const auto first = header.find_first_not_of('[');
    paths.push_back(fmt::format("'{}.{}'", header.substr(first, header.find(']') - first), nearest));
  }
  return paths.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(paths, " or "));
}

std::string unknown_key(std::string_view name, std::string_view path, const std::vector<std::string_view>& known) {
  std::string hint;
  if (nearest_word(name, known).empty()) hint = did_you_mean_elsewhere(path.substr(path.rfind('.') + 1));
  return fmt::format("unknown key '{}'{}", name, hint.empty() ? did_you_mean(name, known) : hint);
}

struct KeySetter {
  std::string_view name;
  std::string_view rest;
  const Given& given;
  bool is_known = false;
  bool is_open = true;
  std::vector<std::string_view> known{};
  std::vector<std::string_view> rivals{};  // keys that exclude this one

  void table(std::string_view, const std::vector<KeyRule>& rules = {}) {
    for (const KeyRule& rule : rules) {
      const bool is_meant = std::find(rule.keys.begin(), rule.keys.end(), name) != rule.keys.end();
      if (!is_meant || (rule.relation != KeyRule::kAtMostOne && rule.relation != KeyRule::kOneOf)) continue;
      std::copy_if(rule.keys.begin(), rule.keys.end(), std::back_inserter(rivals),
                   [&](std::string_view key) { return key != name; });
    }
  }

  template <class Value>
  void operator()(const KeyInfo& key, Value& value) {
    known.push_back(key.name);
    if (key.name != name) return;
    is_known = true;
    is_open = !(rest.empty() && given.is_given) ||
              !(given.is_given(name) || std::any_of(rivals.begin(), rivals.end(), given.is_given));
    if (is_open) set_value(value, key, rest, given);
  }
};

/// Clears those of the named keys that are optional.
struct KeyDropper : FieldVisitor {
  const std::vector<std::string_view>& names;

  template <class Value>
  void operator()(const KeyInfo& key, Value& value) {
    if (std::find(names.begin(), names.end(), key.name) == names.end()) return;
    if constexpr (
        requires { value.reset(); } || requires { value.clear(); })
      value = Value{};
  }
};

template <Table Owner>
void set_key(Owner& owner, std::string_view path, const Given& given) {
  const auto dot = path.find('.');
  const std::string_view rest = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  KeySetter setter{.name = path.substr(0, dot), .rest = rest, .given = given};
  fields(setter, owner);
  if (!setter.is_known) throw Error(ErrorKind::kBadInput, unknown_key(setter.name, path, setter.known));
  if (!setter.is_open) return;
  KeyDropper dropper{{}, setter.rivals};
  fields(dropper, owner);
}

}  // namespace

void set_scene_key(Film& film, std::string_view path, std::string_view text, const KeyIsGiven& is_given) {
  if (path == "materials") refuse(path);  // they would come too late for the bodies
  const bool is_quoted =
      text.size() > 1 && (text[0] == '"' || text[0] == '\'') && text.find(text[0], 1) == text.size() - 1;
  if (is_quoted) text = text.substr(1, text.size() - 2);  // as a scene file has it
  set_key(film, path, {.text = text, .library = *film.library, .is_given = is_given});
}

}  // namespace sprung
