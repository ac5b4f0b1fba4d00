#include "app/scene/material_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "app/scene/built_in_text.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sprung {

Material LibraryMaterial::material() const {
  return {.name = name,
          .young = young,
          .poisson = poisson,
          .density = density,
          .damping = damping,
          .source = young_source,
          .poisson_in_motion = poisson_in_motion,
          .law = law};
}

void MaterialLibrary::add_file(const std::filesystem::path& file) {
  check_readable(file);
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  add(text.str(), file);
}

const LibraryMaterial* MaterialLibrary::find_if_known(std::string_view name) const {
  auto found = std::find_if(materials_.begin(), materials_.end(),
                            [&](const LibraryMaterial& material) { return material.name == name; });
  if (found == materials_.end()) {
    found = std::find_if(materials_.begin(), materials_.end(), [&](const LibraryMaterial& material) {
      return std::equal(name.begin(), name.end(), material.name.begin(), material.name.end(),
                        [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
    });
  }
  return found == materials_.end() ? nullptr : &*found;
}

const LibraryMaterial& MaterialLibrary::find(std::string_view name) const {
  if (const LibraryMaterial* known = find_if_known(name)) return *known;
  std::vector<std::string_view> names;
  for (const LibraryMaterial& material : materials_) names.push_back(material.name);
  throw Error(ErrorKind::kBadInput,
              fmt::format("there is no material '{}'{}; see sprung materials", name, did_you_mean(name, names)));
}

Material MaterialLibrary::named(std::string_view name) const {
  if (name != kAutoMaterial) return find(name).material();
  Material material = built_in_materials()->find(kDefaultMaterial).material();
  material.name = kAutoMaterial;
  return material;
}

std::shared_ptr<const MaterialLibrary> built_in_materials() {
  static const std::shared_ptr<const MaterialLibrary> library = [] {
    auto made = std::make_shared<MaterialLibrary>();
    made->add(built_in_materials_text(), "assets/materials.toml");
    return made;
  }();
  return library;
}

}  // namespace sprung
