#include "render/exposures.h"

#include <fmt/format.h>

#include "render/shaders.h"

namespace sprung {
namespace {

constexpr TextureFormat kLight{GL_RGBA32F, GL_RGBA, GL_FLOAT, false, false, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kPicture{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, false, false, GL_CLAMP_TO_EDGE};

GlProgram load(const GlFunctions& gl, const char* fragment, bool transparent) {
  return load_program(
      gl, "screen.vert", fragment,
      fmt::format("#define RINGS 6\n#define DIRECTIONS 20\n#define TRANSPARENT {}\n", int(transparent)));
}

}  // namespace

Exposures::Exposures(const GlFunctions& gl, int width, int height, bool transparent)
    : gl_(gl),
      width_(width),
      height_(height),
      mean_(make_texture(gl, width, height, kLight)),
      mean_target_(make_texture_target(gl, &mean_, nullptr)),
      picture_(make_texture(gl, width, height, kPicture)),
      picture_target_(make_texture_target(gl, &picture_, nullptr)),
      no_buffers_(make_vertex_array(gl)),
      add_program_(load(gl, "exposure_add.frag", transparent)),
      lens_program_(load(gl, "lens.frag", transparent)),
      develop_program_(load(gl, "exposure_develop.frag", transparent)) {}

void Exposures::clear() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, mean_target_.name());
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void Exposures::add(const GlTexture& light, double part) const {
  add_program_.use();
  add_program_.set("exposure", 0);
  add_program_.set("part", float(part));
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE);
  cover(add_program_, light, mean_target_);
  gl_.Disable(GL_BLEND);
}

void Exposures::add(const GlTexture& light, const GlTexture& circles, double largest, double part) const {
  lens_program_.use();
  lens_program_.set("exposure", 0);
  lens_program_.set("circles", 1);
  lens_program_.set("largest", float(largest));
  lens_program_.set("part", float(part));
  bind_texture(gl_, 1, circles);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE);
  cover(lens_program_, light, mean_target_);
  gl_.Disable(GL_BLEND);
}

void Exposures::set_mean(const std::vector<Eigen::Vector4f>& light) {
  mean_ = make_texture(gl_, width_, height_, kLight, light.data());
  mean_target_ = make_texture_target(gl_, &mean_, nullptr);
}

void Exposures::develop() const {
  develop_program_.use();
  develop_program_.set("mean_light", 0);
  cover(develop_program_, mean_, picture_target_);
}

void Exposures::cover(const GlProgram& program, const GlTexture& source, const GlFramebuffer& target) const {
  program.set("screen_depth", 0.5F);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_DEPTH_TEST);
  bind_texture(gl_, 0, source);
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace sprung
