#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "app/scene/scene_tables.h"
#include "app/scene/scene_values.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sprung {
namespace {

/// What a key is set to.
struct Given {
  std::string_view text;
  const MaterialLibrary& library;
};

[[noreturn]] void refuse(std::string_view path) {
  throw Error(ErrorKind::kBadInput, fmt::format("the key '{}' cannot be set by itself", path));
}

template <class Owner>
void set_key(Owner& owner, std::string_view path, const Given& given);

template <class Value>
concept Word = requires(std::string_view text, const KeyInfo& key, Value& value) {
  parse_value(text, key, value);
};

/// A plain value has to be the end of the path.
template <class Value>
void set_field(Value& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  if constexpr (requires { parse_value(given.text, key, value); }) {
    if (!rest.empty()) refuse(rest);
    parse_value(given.text, key, value);
  } else {
    set_key(value, rest, given);
  }
}

/// A table that is there.
template <class Owner>
requires(!Word<Owner>) void set_field(std::optional<Owner>& owner, const KeyInfo& key, std::string_view rest,
                                      const Given& given) {
  if (!owner) refuse(key.name);
  set_key(*owner, rest, given);
}

/// "[1, 2, 3]", with or without brackets, piece by piece.
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

template <class Values>
void set_items(Values& values, std::size_t count, const KeyInfo& key, std::string_view rest, const Given& given) {
  if (!rest.empty()) refuse(rest);
  const std::vector<std::string_view> items = items_of(given.text);
  if (items.size() != count) {
    throw Error(ErrorKind::kBadInput, fmt::format("must be {} numbers: [1, 2, 3]", count));
  }
  auto value = values.begin();
  for (const std::string_view item : items) parse_value(item, key, *value++);
}

void set_field(Vec3& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  set_items(value, 3, key, rest, given);
}
void set_field(std::array<int, 3>& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  set_items(value, 3, key, rest, given);
}
void set_field(std::optional<Vec3>& value, const KeyInfo& key, std::string_view rest, const Given& given) {
  set_items(value.emplace(), 3, key, rest, given);
}

template <Word Value>
void set_field(std::vector<Value>& values, const KeyInfo& key, std::string_view rest, const Given& given) {
  if (!rest.empty()) refuse(rest);
  values.clear();
  for (const std::string_view item : items_of(given.text)) parse_value(item, key, values.emplace_back());
}

/// From where the program runs; a scene file's own paths are from where it lies.
void set_field(std::filesystem::path& path, const KeyInfo& key, std::string_view rest, const Given& given) {
  if (!rest.empty()) refuse(rest);
  parse_value(given.text, key, path);
  path = std::filesystem::absolute(path).lexically_normal();
  check_readable(path);
}

void set_field(Material& material, const KeyInfo&, std::string_view rest, const Given& given) {
  if (rest.empty()) {
    material = given.library.find(given.text).material();
    return;
  }
  set_key(material, rest, given);
  material.name = "custom";
  material.source.clear();
}

template <class Owner>
requires(!Word<Owner>) void set_field(std::vector<Owner>& owners, const KeyInfo&, std::string_view rest,
                                      const Given& given) {
  for (Owner& owner : owners) set_key(owner, rest, given);
}

/// Whether the value is one that can be left out.
template <class Value>
concept Droppable = requires(Value& value) {
  value.reset();
}
|| requires(Value& value) { value.clear(); };

/// Of keys that exclude each other the one set last stays.
template <class Owner>
void drop_rivals(Owner& owner, std::string_view name) {
  for (const KeyRule& rule : rules<Owner>()) {
    const bool is_meant = std::find(rule.keys.begin(), rule.keys.end(), name) != rule.keys.end();
    if (!is_meant || (rule.kind != KeyRule::Kind::kAtMostOne && rule.kind != KeyRule::Kind::kOneOf)) continue;
    for (const std::string_view rival : rule.keys) {
      if (rival == name) continue;
      const auto drop = [&](auto field) {
        using Value = std::remove_cvref_t<decltype(owner.*field)>;
        if constexpr (Droppable<Value>) owner.*field = Value{};
      };
      std::visit(drop, find_key<Owner>(rival)->member);
    }
  }
}

/// "; did you mean 'body.material.young'?" where a key of nearly that name is in another table; at most three.
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

template <class Owner>
void set_key(Owner& owner, std::string_view path, const Given& given) {
  const auto dot = path.find('.');
  const std::string_view name = path.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  const Key<Owner>* key = find_key<Owner>(name);
  if (key == nullptr) throw Error(ErrorKind::kBadInput, unknown_key(name, path, key_names<Owner>()));
  std::visit([&](auto field) { set_field(owner.*field, *key, rest, given); }, key->member);
  drop_rivals(owner, name);
}

}  // namespace

void set_scene_key(Film& scene, std::string_view path, std::string_view text) {
  if (path == "materials") refuse(path);  // they would come too late for the bodies
  const bool is_quoted =
      text.size() > 1 && (text[0] == '"' || text[0] == '\'') && text.find(text[0], 1) == text.size() - 1;
  if (is_quoted) text = text.substr(1, text.size() - 2);  // as a scene file has it
  set_key(scene, path, {.text = text, .library = *scene.library});
}

}  // namespace sprung
