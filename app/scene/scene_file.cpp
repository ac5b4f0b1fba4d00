#include "app/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "app/scene/table_reader.h"

namespace sprung {
namespace {

/// Before the bodies that are made of them. Of a file that cannot be read the key says what is wrong, as any other.
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
  SceneMistakes mistakes(file.string());
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

}  // namespace sprung
