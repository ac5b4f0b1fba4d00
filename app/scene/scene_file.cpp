#include "app/scene/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <tuple>

#include "app/scene/scene_checks.h"
#include "app/scene/scene_values.h"
#include "app/scene/tension_curve.h"
#include "app/scene/toml.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sprung {
namespace {

/// All mistakes in a file, each with its location.
class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  void add(const toml::source_region& place, std::string text) {
    list_.emplace_back(place.begin.line, place.begin.column, std::move(text));
  }

  /// One Error(kBadInput) with a line "file:line:column: text" for each, in their order in the file.
  void throw_if_any() {
    if (list_.empty()) return;
    std::sort(list_.begin(), list_.end());
    std::vector<std::string> lines;
    for (const auto& [line, column, text] : list_) {
      lines.push_back(fmt::format("{}:{}:{}: {}", file_, line, column, text));
    }
    throw Error(ErrorKind::kBadInput, fmt::format("{}", fmt::join(lines, "\n")));
  }

 private:
  std::string file_;
  std::vector<std::tuple<toml::source_index, toml::source_index, std::string>> list_;
};

toml::table parse_toml(std::string_view text, Mistakes& mistakes) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const bool is_utf8 = error.description().find("utf-8") == std::string_view::npos;
    mistakes.add(error.source(), is_utf8 ? std::string(error.description()) : "not UTF-8 text; save it as UTF-8");
    mistakes.throw_if_any();
    throw;
  }
}

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return fmt::format("an array of {}", node.as_array()->size());
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

[[noreturn]] void refuse_type(const toml::node& node, std::string_view expected) {
  throw Error(ErrorKind::kBadInput, fmt::format("must be {}, not {}", expected, kind_of(node)));
}

const std::string& string_in(const toml::node& node) {
  const auto* text = node.as_string();
  if (text == nullptr) refuse_type(node, "a string");
  return text->get();
}

const toml::array& array_in(const toml::node& node, std::size_t size, std::string_view expected) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != size) refuse_type(node, expected);
  return *array;
}

/// The node at that location, or its nearest ancestor.
toml::source_region find_place(const toml::table& table, const KeyLocation& place) {
  const toml::node* node = table.get(place.key);
  if (node == nullptr) return table.source();
  const toml::array* rows = node->as_array();
  const bool has_row = rows != nullptr && place.row >= 0 && place.row < isize(*rows);
  return has_row ? (*rows)[place.row].source() : node->source();
}

std::string join_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

bool gives_law(const toml::table& material) { return material.contains("law"); }

/// Reads tables into structs by their fields(). The objects that it refers to must outlive it.
class TableReader {
 public:
  TableReader(Mistakes& mistakes, std::filesystem::path folder, SceneFiles files, const MaterialLibrary& library)
      : mistakes_(mistakes), folder_(std::move(folder)), files_(files), library_(library) {}

  template <Table Owner>
  void read(const toml::table& table, const std::string& path, Owner& owner) {
    KeyReader reader{*this, table, path, {}, {}};
    fields(reader, owner);
    std::vector<std::string_view> given;
    for (const auto& [name, node] : table) {
      given.push_back(name.str());
      if (std::find(reader.known.begin(), reader.known.end(), name.str()) != reader.known.end()) continue;
      const std::string hint = did_you_mean(name.str(), reader.known);
      mistakes_.add(name.source(), fmt::format("unknown key '{}'{}", join_path(path, name.str()), hint));
    }
    const Report report = [&](const KeyLocation& place, std::string text) {
      mistakes_.add(find_place(table, place), std::move(text));
    };
    check_rules(reader.rules, given, path, report);
    check_table(owner, path, report);
  }

 private:
  struct KeyReader {
    TableReader& reader;
    const toml::table& source;
    const std::string& path;
    std::vector<KeyRule> rules;
    std::vector<std::string_view> known;

    void table(std::string_view, const std::vector<KeyRule>& rules_of_table = {}) { rules = rules_of_table; }

    template <class Value>
    void operator()(const KeyInfo& key, Value& value) {
      known.push_back(key.name);
      if (const toml::node* node = source.get(key.name)) {
        reader.try_value(*node, join_path(path, key.name), key, value);
      } else if (key.required) {
        reader.mistakes_.add(source.source(), fmt::format("{} lacks the key '{}': {}",
                                                          path.empty() ? "the scene" : path, key.name, key.help));
      }
    }
  };

  template <class Value>
  void try_value(const toml::node& node, const std::string& path, const KeyInfo& key, Value& value) {
    try {
      read_value(node, path, key, value);
    } catch (const Error& error) {
      mistakes_.add(node.source(), fmt::format("{}: {}", path, error.what()));
    }
  }

  template <class Values>
  void try_items(const toml::array& array, const std::string& path, const KeyInfo& key, Values& values) {
    for (int i = 0; i < isize(array); ++i) try_value(array[i], fmt::format("{}[{}]", path, i), key, values[i]);
  }

  static void read_value(const toml::node& node, const std::string&, const KeyInfo& key, double& value) {
    if (const auto* text = node.as_string()) return parse_value(text->get(), key, value);
    const bool takes_unit = key.dimension != Dimension::kNone;
    if (!node.is_number()) refuse_type(node, takes_unit ? "a number or a string with a unit" : "a number");
    value = *node.value<double>();
    check_range(value, key);
  }

  static void read_value(const toml::node& node, const std::string&, const KeyInfo&, bool& value) {
    const auto* truth = node.as_boolean();
    if (truth == nullptr) refuse_type(node, "true or false");
    value = truth->get();
  }

  static void read_value(const toml::node& node, const std::string&, const KeyInfo& key, int& value) {
    const auto* number = node.as_integer();
    if (number == nullptr) refuse_type(node, "a whole number");
    check_range(double(number->get()), key);
    value = int(number->get());
  }

  static void read_value(const toml::node& node, const std::string& path, const KeyInfo& key, BrickCount& value) {
    if (const auto* text = node.as_string()) return parse_value(text->get(), key, value);
    read_value(node, path, key, value.along);
  }

  void read_value(const toml::node& node, const std::string& path, const KeyInfo& key, Vec3& value) {
    try_items(array_in(node, 3, "an array of 3 numbers"), path, key, value);
  }

  template <std::size_t count>
  void read_value(const toml::node& node, const std::string& path, const KeyInfo& key, std::array<int, count>& value) {
    try_items(array_in(node, count, fmt::format("an array of {} whole numbers", count)), path, key, value);
  }

  void read_value(const toml::node& node, const std::string&, const KeyInfo& key, std::filesystem::path& value) {
    parse_value(string_in(node), key, value);
    value = std::filesystem::absolute(folder_ / value).lexically_normal();
    if (files_ == SceneFiles::kPresent) check_readable(value);
  }

  void read_value(const toml::node& node, const std::string& path, const KeyInfo&, Material& value) {
    if (const auto* text = node.as_string()) {
      value = library_.named(text->get());
      return;
    }
    if (!node.is_table()) refuse_type(node, "the name of a material or a table");
    value = Material{};
    read(*node.as_table(), path, value);
    if (std::filesystem::is_regular_file(value.curve)) fit_to_curve(value, gives_law(*node.as_table()));
    value.curve.clear();  // what is left of it are numbers
  }

  template <class Value>
  void read_value(const toml::node& node, const std::string& path, const KeyInfo& key, std::optional<Value>& value) {
    Value read{};
    read_value(node, path, key, read);
    value = std::move(read);
  }

  template <Word Value>
  void read_value(const toml::node& node, const std::string&, const KeyInfo& key, Value& value) {
    parse_value(string_in(node), key, value);
  }

  template <Table Owner>
  void read_value(const toml::node& node, const std::string& path, const KeyInfo&, Owner& owner) {
    if (!node.is_table()) refuse_type(node, "a table");
    read(*node.as_table(), path, owner);
  }

  template <class Value>
  void read_value(const toml::node& node, const std::string& path, const KeyInfo& key, std::vector<Value>& values) {
    const toml::array* array = node.as_array();
    if constexpr (Table<Value>) {
      if (array == nullptr || !array->is_array_of_tables()) refuse_type(node, fmt::format("written as [[{}]]", path));
      for (const toml::node& row : *array) read_value(row, path, key, values.emplace_back(default_table<Value>()));
    } else {
      if (array == nullptr) refuse_type(node, "an array");
      values.resize(array->size());
      try_items(*array, path, key, values);
    }
  }

  Mistakes& mistakes_;
  std::filesystem::path folder_;
  SceneFiles files_;
  const MaterialLibrary& library_;
};

/// Bodies may name the materials of this file. If it cannot be read, the reader reports that at the key.
void add_materials(const toml::table& table, const std::filesystem::path& folder, MaterialLibrary& library) {
  const toml::value<std::string>* name = table["materials"].as_string();
  if (name == nullptr) return;
  const std::filesystem::path file = std::filesystem::absolute(folder / name->get()).lexically_normal();
  if (std::filesystem::is_regular_file(file)) library.add_file(file);
}

}  // namespace

bool is_scene_file(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending == ".toml";
}

Film parse_scene(std::string_view text, const std::filesystem::path& file, SceneFiles files,
                 const MaterialLibrary& library) {
  Mistakes mistakes(file.string());
  const toml::table table = parse_toml(text, mistakes);
  auto known = std::make_shared<MaterialLibrary>(library);
  if (files == SceneFiles::kPresent) add_materials(table, file.parent_path(), *known);
  Film scene;
  scene.library = known;
  TableReader(mistakes, file.parent_path(), files, *known).read(table, "", scene);
  mistakes.throw_if_any();
  return scene;
}

Film read_scene(const std::filesystem::path& file, const MaterialLibrary& library) {
  check_readable(file);
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_scene(text.str(), file, SceneFiles::kPresent, library);
}

namespace {

/// Whether a table of a file has a key, given the path below it of the table that has it.
KeyIsGiven given_in(const toml::table& table, std::string_view path) {
  const toml::node* node = &table;
  for (auto dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.')) {
    const toml::table* parent = node->as_table();
    if (parent == nullptr) return [](std::string_view) { return true; };  // "rubber" says all of body.material
    node = parent->get(path.substr(0, dot));
    if (node == nullptr) return [](std::string_view) { return false; };
    path.remove_prefix(dot + 1);
  }
  const toml::table* parent = node->as_table();
  return [parent](std::string_view key) { return parent == nullptr || parent->contains(key); };
}

}  // namespace

void set_if_unset(Film& film, const std::filesystem::path& file, std::string_view path, std::string_view text) {
  Mistakes mistakes(file.string());
  const toml::table table = parse_toml(read_file(file), mistakes);
  constexpr std::string_view kBody = "body.";
  if (!path.starts_with(kBody)) return set_scene_key(film, path, text, given_in(table, path));
  const toml::array* rows = table["body"].as_array();
  for (std::size_t row = 0; row < film.bodies.size(); ++row) {
    Film single;
    single.library = film.library;
    single.bodies = {std::move(film.bodies[row])};
    set_scene_key(single, path, text, given_in(*(*rows)[row].as_table(), path.substr(kBody.size())));
    film.bodies[row] = std::move(single.bodies.front());
  }
}

namespace {

/// Young's modulus and the law as the material's curve has them.
void fit_library_material(LibraryMaterial& material, bool keeps_law) {
  Material fitted = material.material();
  fitted.curve = material.curve;
  fit_to_curve(fitted, keeps_law);
  material.young = fitted.young;
  material.law = fitted.law;
  for (std::string* source : {&material.young_source, &material.law_source}) {
    *source += (source->empty() ? "" : "; ") + fitted.source;
  }
}

}  // namespace

void MaterialLibrary::add(std::string_view text, const std::filesystem::path& file) {
  Mistakes mistakes(file.string());
  const toml::table table = parse_toml(text, mistakes);
  MaterialFile read;
  TableReader(mistakes, file.parent_path(), SceneFiles::kPresent, *this).read(table, "", read);
  const std::size_t before = materials_.size();
  for (int i = 0; i < isize(read.materials); ++i) {
    LibraryMaterial& material = read.materials[i];
    if (std::filesystem::is_regular_file(material.curve)) {
      try {
        fit_library_material(material, gives_law(*(*table["material"].as_array())[i].as_table()));
      } catch (const Error& error) {
        mistakes.add(find_place(table, {"material", i}), fmt::format("material.curve: {}", error.what()));
      }
    }
    const LibraryMaterial* known = find_if_known(material.name);
    if (known == nullptr) {
      materials_.push_back(std::move(material));
      continue;
    }
    const bool is_here = known >= materials_.data() + before;
    mistakes.add(find_place(table, {"material", i}),
                 fmt::format("material.name: '{}' exists already, {}; choose another name", material.name,
                             is_here ? "in this file" : "built in or in another file"));
  }
  mistakes.throw_if_any();
}

}  // namespace sprung
