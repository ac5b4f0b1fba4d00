#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"

namespace sprung {
namespace {

/// Types that need a [section] or [[sections]] of their own; they follow the plain keys of their table.
template <class Value>
constexpr bool kIsSection =
    std::is_same_v<Value, SceneCamera> || std::is_same_v<Value, SceneRender> || std::is_same_v<Value, SceneSolver> ||
    std::is_same_v<Value, SceneContact> || std::is_same_v<Value, Experiment>;
template <class Owner>
constexpr bool kIsSection<std::vector<Owner>> = std::is_class_v<Owner>;
template <>
constexpr bool kIsSection<std::vector<Keyframe>> = false;
template <>
constexpr bool kIsSection<std::vector<Strength>> = false;
template <>
constexpr bool kIsSection<std::vector<GravityKeyframe>> = false;
template <>
constexpr bool kIsSection<std::vector<CameraKeyframe>> = false;

template <class Owner>
std::string inline_table(const Owner& owner);

bool is_built_in(const Material& material) {
  const auto same = [&](const LibraryMaterial& known) {
    return known.name == material.name && known.young == material.young && known.poisson == material.poisson &&
           known.density == material.density && known.damping == material.damping;
  };
  const auto materials = built_in_materials()->materials();
  return std::any_of(materials.begin(), materials.end(), same);
}

template <class Value>
std::string value_text(const Value& value) {
  if constexpr (requires { toml_text(value); }) {
    return toml_text(value);
  } else {
    return inline_table(value);
  }
}
template <>
std::string value_text(const Material& material) {
  return is_built_in(material) ? toml_text(std::string_view(material.name)) : inline_table(material);
}
template <class Keyframes>
std::string inline_tables(const Keyframes& keyframes) {
  std::string text;
  for (const auto& keyframe : keyframes) text += (text.empty() ? "" : ", ") + inline_table(keyframe);
  return fmt::format("[{}]", text);
}
template <>
std::string value_text(const std::vector<Keyframe>& keyframes) {
  return inline_tables(keyframes);
}
template <>
std::string value_text(const std::vector<Strength>& keyframes) {
  return inline_tables(keyframes);
}
template <>
std::string value_text(const std::vector<GravityKeyframe>& keyframes) {
  return inline_tables(keyframes);
}
template <>
std::string value_text(const std::vector<CameraKeyframe>& keyframes) {
  return inline_tables(keyframes);
}

/// " name = value", or nothing for an optional value that is not there.
template <class Value>
std::string assignment(std::string_view name, const Value& value) {
  return fmt::format("{} = {}", name, value_text(value));
}
template <class Value>
std::string assignment(std::string_view name, const std::optional<Value>& value) {
  return value ? assignment(name, *value) : "";
}
template <class Value>
requires requires(const Value& value) { value.empty(); }
std::string assignment(std::string_view name, const Value& value) {
  return value.empty() ? "" : fmt::format("{} = {}", name, value_text(value));
}

template <class Owner>
std::vector<std::string> assignments(const Owner& owner) {
  std::vector<std::string> lines;
  for (const Key<Owner>& key : keys<Owner>()) {
    std::visit(
        [&](auto field) {
          using Value = std::remove_cvref_t<decltype(owner.*field)>;
          if constexpr (!kIsSection<Value>) lines.push_back(assignment(key.name, owner.*field));
        },
        key.member);
  }
  std::erase(lines, "");
  return lines;
}

template <class Owner>
std::string inline_table(const Owner& owner) {
  std::string text;
  for (const std::string& line : assignments(owner)) text += (text.empty() ? "" : ", ") + line;
  return fmt::format("{{ {} }}", text);
}

/// Writes tables, parents before children.
class Printer {
 public:
  template <class Owner>
  void print(const Owner& owner, const std::string& path) {
    for (const std::string& line : assignments(owner)) text_ += line + "\n";
    for (const Key<Owner>& key : keys<Owner>()) {
      const std::string full = path.empty() ? std::string(key.name) : fmt::format("{}.{}", path, key.name);
      std::visit(
          [&](auto field) {
            using Value = std::remove_cvref_t<decltype(owner.*field)>;
            if constexpr (kIsSection<Value>) section(owner.*field, full);
          },
          key.member);
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class Value>
  void section(const Value& value, const std::string& path) {
    if (assignments(value).empty()) return;
    text_ += fmt::format("\n[{}]\n", path);
    print(value, path);
  }
  template <class Value>
  void section(const std::vector<Value>& values, const std::string& path) {
    for (const Value& value : values) {
      text_ += fmt::format("\n[[{}]]\n", path);
      print(value, path);
    }
  }

  std::string text_;
};

}  // namespace

std::string print_scene(const Film& scene) {
  Printer printer;
  printer.print(scene, "");
  return printer.text();
}

}  // namespace sprung
