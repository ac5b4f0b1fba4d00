#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "app/scene/scene_values.h"

namespace sprung {
namespace {

/// Tables that are always there get a [section] of their own, rows of tables a [[section]] each; both follow the plain
/// keys of the table they are in. Materials, keyframes and optional tables are written in braces.
template <class Value>
constexpr bool kIsSection = Table<Value> && !std::is_same_v<Value, Material>;
template <Table Row>
constexpr bool kIsSection<std::vector<Row>> = !requires(Row row) {
  row.time;
};

bool is_built_in(const Material& material) {
  const auto same = [&](const LibraryMaterial& known) {
    return known.name == material.name && known.young == material.young && known.poisson == material.poisson &&
           known.poisson_in_motion == material.poisson_in_motion && known.density == material.density &&
           known.damping == material.damping && known.law == material.law;
  };
  const auto materials = built_in_materials()->materials();
  return std::any_of(materials.begin(), materials.end(), same);
}

template <class Value>
bool is_given(const Value& value) {
  if constexpr (requires { value.empty(); }) return !value.empty();
  if constexpr (requires { value.has_value(); }) return value.has_value();
  return true;
}

template <Table Owner>
std::string inline_table(const Owner& owner);

template <class Value>
std::string value_text(const Value& value) {
  if constexpr (std::is_same_v<Value, Material>) {
    return is_built_in(value) ? toml_text(value.name) : inline_table(value);
  } else if constexpr (Table<Value>) {
    return inline_table(value);
  } else {
    return toml_text(value);
  }
}
template <class Value>
std::string value_text(const std::optional<Value>& value) {
  return value_text(*value);
}
template <class Value>
std::string value_text(const std::vector<Value>& values) {
  std::vector<std::string> items;
  items.reserve(values.size());
  for (const Value& value : values) items.push_back(value_text(value));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

/// "key = value" for every key of a table that needs no section.
struct Assignments : FieldVisitor {
  std::vector<std::string> lines;

  template <class Value>
  void operator()(const KeyInfo& key, const Value& value) {
    if constexpr (!kIsSection<Value>) {
      if (is_given(value)) lines.push_back(fmt::format("{} = {}", key.name, value_text(value)));
    }
  }
};

template <Table Owner>
std::vector<std::string> assignments(const Owner& owner) {
  Assignments visitor;
  fields(visitor, owner);
  return visitor.lines;
}

template <Table Owner>
std::string inline_table(const Owner& owner) {
  return fmt::format("{{ {} }}", fmt::join(assignments(owner), ", "));
}

/// Writes a table, then the sections below it.
struct Printer : FieldVisitor {
  std::string path;  // of the table, with a dot at the end
  std::string& text;

  Printer(std::string path_of_table, std::string& all_text) : path(std::move(path_of_table)), text(all_text) {}

  template <Table Owner>
  void print(const Owner& owner) {
    for (const std::string& line : assignments(owner)) text += line + "\n";
    fields(*this, owner);
  }

  template <class Value>
  void operator()(const KeyInfo& key, const Value& value) {
    if constexpr (kIsSection<Value>) section(path + std::string(key.name), value);
  }

  template <Table Owner>
  void section(const std::string& name, const Owner& owner) {
    if (assignments(owner).empty()) return;
    text += fmt::format("\n[{}]\n", name);
    Printer(name + ".", text).print(owner);
  }
  template <Table Owner>
  void section(const std::string& name, const std::vector<Owner>& rows) {
    for (const Owner& row : rows) {
      text += fmt::format("\n[[{}]]\n", name);
      Printer(name + ".", text).print(row);
    }
  }
};

}  // namespace

std::string print_scene(const Film& film) {
  std::string text;
  Printer("", text).print(film);
  return text;
}

}  // namespace sprung
