#include "app/film/draw_diverged.h"

#include <fmt/format.h>

#include <string>

#include "core/error.h"
#include "core/files.h"
#include "render/body_picture.h"
#include "render/image/png.h"

namespace sprung {
namespace {

/// Returns what the message adds about the picture, or nothing.
std::string draw(const Body& body, const std::filesystem::path& picture) {
  if (!body.positions.allFinite()) return "";
  try {
    const BodyPicture drawn = draw_body(body, {.color_by = ColorBy::kStrain, .width = 1280, .height = 800});
    make_folder(picture.parent_path());
    write_png(drawn.image, picture);
    return fmt::format("; {} shows its bricks before, coloured by strain from {:.3g} to {:.3g} %", picture.string(),
                       drawn.low, drawn.high);
  } catch (const Error&) {
    return "";  // the first error matters more
  }
}

}  // namespace

Recording with_picture_of_diverged(const World& world, const std::filesystem::path& picture,
                                   const std::function<Recording()>& work) {
  try {
    return work();
  } catch (const Diverged& error) {
    throw Error(error.kind(), error.what() + draw(world.bodies[error.body()], picture));
  }
}

}  // namespace sprung
