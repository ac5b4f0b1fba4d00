#include "app/scene/film.h"

namespace sprung {

namespace {

/// Null for one that the library does not know.
const LibraryMaterial* material_of(const SceneBody& body, const MaterialLibrary& library) {
  return library.find_if_known(body.material.name == kAutoMaterial ? kDefaultMaterial : body.material.name);
}

}  // namespace

Look look_of(const SceneBody& body, const MaterialLibrary& library) {
  if (body.look) return *body.look;
  const LibraryMaterial* known = material_of(body, library);
  return known == nullptr ? Look::kPlastic : known->look;
}

std::optional<Color> color_of(const SceneBody& body, const MaterialLibrary& library) {
  if (body.color) return body.color;
  const LibraryMaterial* known = material_of(body, library);
  return known == nullptr ? std::nullopt : known->color;
}

double mean_free_path_of(const SceneBody& body, const MaterialLibrary& library) {
  constexpr double kOfGelatin = 0.025;  // m
  const LibraryMaterial* known = material_of(body, library);
  const bool is_of_material = known != nullptr && look_of(body, library) == known->look;
  if (is_of_material) return known->mean_free_path;
  return body.look == Look::kGelatin ? kOfGelatin : 0;
}

Film with_defaults(Film film) {
  for (SceneBody& body : film.bodies) {
    if (!body.size && !body.scale && !body.mesh.empty()) body.size = kDefaultSize;
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks;
    if (body.material.name == kAutoMaterial) body.material.name = kDefaultMaterial;
    if (built_in_materials()->find_if_known(body.material.name) != nullptr) continue;
    body.look = look_of(body, *film.library);
    body.color = color_of(body, *film.library);
  }
  return film;
}

SceneBody default_body() {
  SceneBody body;
  body.material = built_in_materials()->named(kAutoMaterial);
  return body;
}

}  // namespace sprung
