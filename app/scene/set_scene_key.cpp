#include <fmt/format.h>

#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"
#include "core/error.h"
#include "core/mesh/read/file_checks.h"
#include "core/nearest.h"

namespace sprung {
namespace {

[[noreturn]] void refuse(std::string_view path) {
  throw Error(ErrorKind::kBadInput, fmt::format("the key '{}' cannot be set by itself", path));
}

template <class Owner>
void set_key(Owner& owner, std::string_view path, std::string_view text);

/// A plain value has to be the end of the path.
template <class Value>
void set_field(Value& value, const KeyInfo& key, std::string_view rest, std::string_view text) {
  if constexpr (requires { parse_value(text, key, value); }) {
    if (!rest.empty()) refuse(rest);
    parse_value(text, key, value);
  } else {
    set_key(value, rest, text);
  }
}

void set_field(Vec3&, const KeyInfo& key, std::string_view, std::string_view) { refuse(key.name); }
void set_field(std::optional<Vec3>&, const KeyInfo& key, std::string_view, std::string_view) { refuse(key.name); }

template <class Value>
concept Word = requires(std::string_view text, const KeyInfo& key, Value& value) {
  parse_value(text, key, value);
};

template <Word Value>
void set_field(std::vector<Value>&, const KeyInfo& key, std::string_view, std::string_view) {
  refuse(key.name);
}

/// From where the program runs; a scene file's own paths are from where it lies.
void set_field(std::filesystem::path& path, const KeyInfo& key, std::string_view rest, std::string_view text) {
  if (!rest.empty()) refuse(rest);
  parse_value(text, key, path);
  path = std::filesystem::absolute(path).lexically_normal();
  check_readable(path);
}

void set_field(Material& material, const KeyInfo& key, std::string_view rest, std::string_view text) {
  if (rest.empty()) return parse_value(text, key, material);
  set_key(material, rest, text);
  material.name = "custom";
  material.source.clear();
}

template <class Owner>
requires(!Word<Owner>) void set_field(std::vector<Owner>& owners, const KeyInfo&, std::string_view rest,
                                      std::string_view text) {
  for (Owner& owner : owners) set_key(owner, rest, text);
}

template <class Owner>
void drop_rival(Owner&, std::string_view) {}

void drop_rival(SceneBody& body, std::string_view name) {
  if (name == "size") body.scale.reset();
  if (name == "scale") body.size.reset();
  if (name == "bricks") body.brick_size.reset();
  if (name == "brick_size") body.bricks.reset();
}

template <class Owner>
void set_key(Owner& owner, std::string_view path, std::string_view text) {
  const auto dot = path.find('.');
  const std::string_view name = path.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  const Key<Owner>* key = find_key<Owner>(name);
  if (key == nullptr) {
    throw Error(ErrorKind::kBadInput, fmt::format("unknown key '{}'{}", name, did_you_mean(name, key_names<Owner>())));
  }
  std::visit([&](auto field) { set_field(owner.*field, *key, rest, text); }, key->member);
  drop_rival(owner, name);
}

}  // namespace

void set_scene_key(Scene& scene, std::string_view path, std::string_view text) { set_key(scene, path, text); }

}  // namespace sprung
