#include "app/scene/film.h"

namespace sprung {

Look look_of(const SceneBody& body, const MaterialLibrary& library) {
  if (body.look) return *body.look;
  const bool is_auto = body.material.name == kAutoMaterial;
  const LibraryMaterial* known = library.find_if_known(is_auto ? kDefaultMaterial : body.material.name);
  return known == nullptr ? Look::kPlastic : known->look;
}

double mean_free_path_of(const SceneBody& body, const MaterialLibrary& library) {
  constexpr double kOfGelatin = 0.025;  // m
  const bool is_auto = body.material.name == kAutoMaterial;
  const LibraryMaterial* known = library.find_if_known(is_auto ? kDefaultMaterial : body.material.name);
  if (!body.look) return known == nullptr ? 0 : known->mean_free_path;
  if (known != nullptr && known->look == *body.look) return known->mean_free_path;
  return *body.look == Look::kGelatin ? kOfGelatin : 0;
}

Film with_defaults(Film film) {
  for (SceneBody& body : film.bodies) {
    if (!body.size && !body.scale && !body.mesh.empty()) body.size = kDefaultSize;
    if (!body.bricks && !body.brick_size) body.bricks = kDefaultBricks;
    if (body.material.name == kAutoMaterial) body.material.name = kDefaultMaterial;
    if (built_in_materials()->find_if_known(body.material.name) == nullptr) body.look = look_of(body, *film.library);
  }
  return film;
}

SceneBody default_body() {
  SceneBody body;
  body.material = built_in_materials()->named(kAutoMaterial);
  return body;
}

}  // namespace sprung
