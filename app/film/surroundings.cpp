#include "app/film/surroundings.h"

#include <span>
#include <string>

#include "core/error.h"
#include "core/io/decode_image.h"
#include "core/mesh/io/file_checks.h"

namespace sprung {

std::optional<Environment> read_surroundings(const SceneRender& render) {
  if (render.environment.empty()) return std::nullopt;
  const std::string name = render.environment.string();
  const std::string bytes = read_bytes(render.environment);
  const Panorama panorama = decode_panorama(std::as_bytes(std::span(bytes)), name);
  try {
    return Environment(panorama);
  } catch (const Error& error) {
    throw Error(error.kind(), name + ": " + error.what());
  }
}

}  // namespace sprung
