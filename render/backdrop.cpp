#include "render/backdrop.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>

#include "render/shaders.h"

namespace sprung {
namespace {

constexpr double kSightSteps = 1 << 20;  // one over the step to which lines of sight are rounded
constexpr TextureFormat kPattern{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_REPEAT};

std::string backdrop_defines(const Floor& floor, bool has_panorama) {
  return std::string(floor.has_horizon ? "#define LEVEL\n" : "") + (floor.pattern ? "#define PATTERN\n" : "") +
         (has_panorama ? "#define PANORAMA\n" : "");
}

GlTexture make_pattern(const GlFunctions& gl, const Floor& floor) {
  if (!floor.pattern) return {};
  return make_texture(gl, floor.pattern->width, floor.pattern->height, kPattern, floor.pattern->rgba.data());
}

GlTexture make_panorama(const GlFunctions& gl, const Panorama* panorama) {
  if (panorama == nullptr) return {};
  const std::array<const float*, 1> levels{panorama->light.front().data()};
  return make_level_texture(gl, panorama->width, panorama->height, levels, GL_RGBA16F);
}

}  // namespace

Backdrop::Backdrop(const GlFunctions& gl, int width, int height, const TextureFormat& format, const Floor& floor,
                   const std::optional<Environment>& environment, const std::string& defines)
    : gl_(gl),
      width_(width),
      height_(height),
      floor_(floor),
      panorama_(environment ? environment->background : nullptr),
      panorama_scale_(environment ? environment->scale : 1),
      pattern_texture_(make_pattern(gl, floor_)),
      panorama_texture_(make_panorama(gl, panorama_.get())),
      picture_(make_texture(gl, width, height, format)),
      target_(make_texture_target(gl, &picture_, nullptr)),
      no_buffers_(make_vertex_array(gl)),
      program_(
          load_program(gl, "screen.vert", "backdrop.frag", defines + backdrop_defines(floor_, panorama_ != nullptr))) {}

Backdrop::Sight Backdrop::sight_of(const View& view) const {
  const auto rounded = [](double value) { return float(std::round(kSightSteps * value) / kSightSteps); };
  Sight sight{view.sight.row(1).transpose().unaryExpr(rounded), view.sight_slopes.unaryExpr(rounded)};
  if (!is_even()) sight.stage_from_clip = view.clip_from_stage.inverse().cast<float>();
  return sight;
}

void Backdrop::draw(const View& view, bool shows_floor) {
  const Sight sight = sight_of(view);
  if (drawn_ == sight) return;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl_.Viewport(0, 0, width_, height_);
  program_.use();
  view.frame.set_common(program_);
  program_.set("sight_height", sight.height);
  program_.set("sight_slopes", sight.slopes);
  if (!is_even()) set_floor(view, shows_floor);
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  drawn_ = sight;
}

void Backdrop::set_floor(const View& view, bool shows_floor) const {
  program_.set("sight_x", view.sight.row(0).transpose().cast<float>().eval());
  program_.set("sight_z", view.sight.row(2).transpose().cast<float>().eval());
  program_.set("floor_end", shows_floor ? floor_.end() : Eigen::Vector2f(-3, -2));
  program_.set("stage_from_clip", view.clip_from_stage.inverse().cast<float>().eval());
  if (floor_.pattern) {
    const StageSpace& space = view.frame.space;
    const Eigen::Array2d sides = floor_.pattern->sides;
    const Eigen::Array2d center = Eigen::Array2d(space.center.x(), space.center.z()) / sides;
    Eigen::Vector4d from_stage;
    from_stage << 1 / (space.scale * sides), center - center.floor();
    program_.set("pattern_from_stage", from_stage.cast<float>().eval());
    bind_texture(gl_, 0, pattern_texture_);
    program_.set("pattern", 0);
  }
  if (panorama_) {
    bind_texture(gl_, 1, panorama_texture_);
    program_.set("panorama", 1);
    program_.set("panorama_scale", panorama_scale_);
  }
}

}  // namespace sprung
