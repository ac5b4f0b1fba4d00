#include "render/light_maps.h"

#include <Eigen/LU>
#include <array>
#include <utility>

#include "render/shaders.h"

namespace sprung {

namespace {

constexpr int kKeySize = 1024;  // texels
constexpr int kKeyMaskSize = kKeySize / 2;
constexpr int kZenithDepthSize = 512;
constexpr int kZenithSize = kZenithDepthSize / 4;
constexpr int kUndersideColorSize = 512;
constexpr int kUndersideSize = kUndersideColorSize / 2;
constexpr int kGroundSkySize = 128;
constexpr int kGroundLightSize = 512;
constexpr float kZenithBlur = 0.45F;  // of a body's radius: three standard deviations

constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false, GL_CLAMP_TO_BORDER};
constexpr TextureFormat kColor{GL_RGBA16F, GL_RGBA, GL_FLOAT, true, true, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kMask{GL_RG16F, GL_RG, GL_FLOAT, true, true, GL_CLAMP_TO_BORDER};
constexpr TextureFormat kMoments{GL_RG32F, GL_RG, GL_FLOAT, false, true, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kFlat{GL_RGBA16F, GL_RGBA, GL_FLOAT, false, true, GL_CLAMP_TO_EDGE};

void set_border(const GlFunctions& gl, float value) {
  const std::array<float, 4> border{value, value, value, value};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border.data());
}

LightMap make_map(const GlFunctions& gl, int size, const TextureFormat* color, bool depth) {
  LightMap map;
  if (color != nullptr) {
    map.color = make_texture(gl, size, size, *color);
    set_border(gl, 0);
  }
  if (depth) {
    map.depth = make_texture(gl, size, size, kDepth);
    set_border(gl, 1);
  }
  map.target = make_texture_target(gl, color != nullptr ? &map.color : nullptr, depth ? &map.depth : nullptr);
  return map;
}

/// Reads the first level alone, which is half the work.
GlSampler make_flat_sampler(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenSamplers(1, &name);
  for (const auto& [key, value] : {std::pair<GLenum, GLint>{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                   {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                   {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                   {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}}) {
    gl.SamplerParameteri(name, key, value);
  }
  return {gl, name};
}

GlSampler make_shadow_sampler(const GlFunctions& gl) {
  GLuint name = 0;
  gl.GenSamplers(1, &name);
  for (const auto& [key, value] : {std::pair<GLenum, GLint>{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                   {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                   {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                   {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                   {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                                   {GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}}) {
    gl.SamplerParameteri(name, key, value);
  }
  return {gl, name};
}

Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides) {
  Eigen::Vector4f values;
  values << low.cast<float>(), sides.cast<float>();
  return values;
}

/// Low corner and one over the sides, in x and z, of a view that looks up or down.
Eigen::Vector4f lookup_rectangle(const LightView& view) {
  return rectangle(view.low.head<2>(), view.sides.head<2>().cwiseInverse());
}

}  // namespace

void DrawFrame::set_common(const GlProgram& program) const {
  program.set("stage_center", space.center.cast<float>().eval());
  program.set("stage_scale", static_cast<float>(space.scale));
  program.set("to_key", to_key_light().cast<float>().eval());
  program.set("body_radius", static_cast<float>(body_radius));
  program.set("ground_height", static_cast<float>(ground_height));
  program.set("ground_rectangle", rectangle(light.ground.low, light.ground.sides));
  program.set("light_from_stage", light.key.clip_from_stage.cast<float>().eval());
}

LightMaps::LightMaps(const GlFunctions& gl)
    : gl_(gl),
      no_buffers_(make_vertex_array(gl)),
      shadow_sampler_(make_shadow_sampler(gl)),
      flat_sampler_(make_flat_sampler(gl)),
      key_(make_map(gl, kKeySize, nullptr, true)),
      key_mask_(make_map(gl, kKeyMaskSize, &kMask, false)),
      zenith_depth_(make_map(gl, kZenithDepthSize, nullptr, true)),
      zenith_(make_map(gl, kZenithSize, &kMoments, false)),
      zenith_pass_(make_map(gl, kZenithSize, &kMoments, false)),
      underside_color_(make_map(gl, kUndersideColorSize, &kColor, true)),
      underside_(make_map(gl, kUndersideSize, &kMask, false)),
      ground_sky_(make_map(gl, kGroundSkySize, &kFlat, false)),
      ground_light_(make_map(gl, kGroundLightSize, &kColor, true)),
      depth_program_(load_program(gl, "depth.vert", "depth.frag")),
      zenith_program_(load_program(gl, "screen.vert", "zenith_filter.frag")),
      blur_program_(load_program(gl, "screen.vert", "blur.frag")),
      underside_programs_(load_skin_programs(gl, "underside.frag")),
      underside_filter_program_(load_program(gl, "screen.vert", "underside_filter.frag")),
      ground_sky_program_(load_program(gl, "screen.vert", "ground_sky.frag")),
      key_mask_program_(load_program(gl, "screen.vert", "key_mask.frag")),
      open_ground_program_(load_program(gl, "screen.vert", "ground_light.frag")),
      ground_shadow_program_(load_program(gl, "screen.vert", "ground_light.frag", "#define SHADOW\n")) {}

void LightMaps::draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
                     PassClock& clock) {
  gl_.Enable(GL_DEPTH_TEST);
  draw_depth(key_, kKeySize, frame.light.key, skins, frame);
  clock.stop("key map");
  draw_depth(zenith_depth_, kZenithDepthSize, frame.light.zenith, skins, frame);
  clock.stop("zenith map");
  if (frame.has_ground) draw_underside(skins, textures, frame);
  clock.stop("underside map");
  gl_.Disable(GL_DEPTH_TEST);
  blur_zenith(frame);
  clock.stop("zenith blur");
  if (frame.has_ground) {
    draw_ground_sky(frame);
    clock.stop("ground sky");
    draw_key_mask(frame);
    clock.stop("key mask");
  } else {  // a floor far below, which nothing shades
    clear(ground_sky_, kGroundSkySize);
    clear(key_mask_, kKeyMaskSize);
  }
  draw_ground_light(frame);
  clock.stop("ground light");
}

void LightMaps::draw_depth(const LightMap& map, int size, const LightView& view, const std::vector<SkinBuffers>& skins,
                           const DrawFrame& frame) const {
  clear(map, size);
  depth_program_.use();
  frame.set_common(depth_program_);
  depth_program_.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
  for (const SkinBuffers& skin : skins) skin.draw(Detail::kCoarse);
}

void LightMaps::draw_underside(const std::vector<SkinBuffers>& skins, const TextureSet& textures,
                               const DrawFrame& frame) const {
  clear(underside_color_, kUndersideColorSize);
  for (const GlProgram* program : {&underside_programs_.plain, &underside_programs_.textured}) {
    program->use();
    frame.set_common(*program);
    program->set("clip_from_stage", frame.light.nadir.clip_from_stage.cast<float>().eval());
  }
  for (const SkinBuffers& skin : skins) skin.draw(underside_programs_, textures, 0, Detail::kCoarse);
  make_mipmaps(underside_color_.color);

  underside_filter_program_.use();
  bind_texture(gl_, 0, underside_color_.color);
  underside_filter_program_.set("source", 0);
  gl_.Disable(GL_DEPTH_TEST);
  fill(underside_, kUndersideSize);
  make_mipmaps(underside_.color);
}

void LightMaps::blur_zenith(const DrawFrame& frame) const {
  zenith_program_.use();
  bind_texture(gl_, 0, zenith_depth_.depth);
  zenith_program_.set("zenith_depth", 0);
  fill(zenith_, kZenithSize);

  blur_program_.use();
  blur_program_.set("source", 0);
  const float reach = kZenithBlur * static_cast<float>(frame.body_radius);
  const Eigen::Vector2f sides = frame.light.zenith.sides.head<2>().cast<float>();
  bind_texture(gl_, 0, zenith_.color);
  blur_program_.set("reach", Eigen::Vector2f(reach / sides.x(), 0));
  fill(zenith_pass_, kZenithSize);
  bind_texture(gl_, 0, zenith_pass_.color);
  blur_program_.set("reach", Eigen::Vector2f(0, reach / sides.y()));
  fill(zenith_, kZenithSize);
}

void LightMaps::draw_ground_sky(const DrawFrame& frame) const {
  const GlProgram& program = ground_sky_program_;
  program.use();
  frame.set_common(program);
  program.set("underside_rectangle", lookup_rectangle(frame.light.nadir));
  program.set("underside_texels", static_cast<float>(kUndersideSize));
  bind_texture(gl_, 0, underside_.color);
  program.set("underside", 0);
  bind_texture(gl_, 1, underside_color_.color);
  program.set("underside_color", 1);
  fill(ground_sky_, kGroundSkySize);
}

void LightMaps::draw_key_mask(const DrawFrame& frame) const {
  const LightView& key = frame.light.key;
  // Clip coordinates are 2 (u, v, depth) - 1; the row of the inverse that gives y, less the ground's height.
  const Eigen::RowVector4d y = key.clip_from_stage.inverse().row(1);
  const Eigen::Vector4d height(2 * y[0], 2 * y[1], 2 * y[2], y[3] - y[0] - y[1] - y[2] - frame.ground_height);
  key_mask_program_.use();
  frame.set_common(key_mask_program_);
  key_mask_program_.set("height_from_light", height.cast<float>().eval());
  bind_texture(gl_, 0, key_.depth);
  key_mask_program_.set("key_depth", 0);
  fill(key_mask_, kKeyMaskSize);
  make_mipmaps(key_mask_.color);
}

/// First the open ground and, in the depth, where there may be shadow. There the light is found once more: an early
/// depth test keeps llvmpipe from running the costly shader elsewhere.
void LightMaps::draw_ground_light(const DrawFrame& frame) const {
  constexpr float kShaded = 0.5F;
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_ALWAYS);
  draw_ground_light(open_ground_program_, 1, frame);
  gl_.DepthFunc(GL_EQUAL);
  draw_ground_light(ground_shadow_program_, kShaded, frame);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_DEPTH_TEST);
  make_mipmaps(ground_light_.color);
}

void LightMaps::draw_ground_light(const GlProgram& program, float depth, const DrawFrame& frame) const {
  program.use();
  frame.set_common(program);
  const Eigen::Vector2f sides = frame.light.key.sides.head<2>().cast<float>();
  program.set("mask_texels", static_cast<float>(kKeyMaskSize) / sides.x());
  program.set("mask_texel_size", (Eigen::Vector2f(1, sides.x() / sides.y()) / kKeyMaskSize).eval());
  bind_texture(gl_, 0, key_mask_.color);
  program.set("key_mask", 0);
  bind_texture(gl_, 1, ground_sky_.color);
  program.set("ground_sky", 1);
  program.set("screen_depth", depth);
  fill(ground_light_, kGroundLightSize);
}

void LightMaps::bind(const GlProgram& program, const DrawFrame& frame, int first_unit) const {
  const LightView& key = frame.light.key;
  const LightView& zenith = frame.light.zenith;
  frame.set_common(program);
  program.set("light_texel", Eigen::Vector2f(key.sides.head<2>().cwiseInverse().cast<float>()));
  program.set("key_depth_range", static_cast<float>(key.sides.z()));
  program.set("zenith_rectangle", lookup_rectangle(zenith));
  program.set("zenith_heights", Eigen::Vector2f(static_cast<float>(-zenith.low.z() - zenith.sides.z()),
                                                static_cast<float>(1 / zenith.sides.z())));
  program.set("ground_texels", static_cast<float>(kGroundLightSize / frame.light.ground.sides.maxCoeff()));
  bind_texture(gl_, first_unit, key_.depth, shadow_sampler_.name());
  program.set("key_shadow_map", first_unit);
  bind_texture(gl_, first_unit + 1, key_.depth);
  program.set("key_depth", first_unit + 1);
  bind_texture(gl_, first_unit + 2, zenith_.color);
  program.set("zenith", first_unit + 2);
  bind_texture(gl_, first_unit + 3, ground_light_.color);
  program.set("ground_light", first_unit + 3);
  bind_texture(gl_, first_unit + 4, ground_light_.color, flat_sampler_.name());
  program.set("sharp_ground_light", first_unit + 4);
}

void LightMaps::fill(const LightMap& map, int size) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, size, size);
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void LightMaps::clear(const LightMap& map, int size) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, size, size);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void LightMaps::make_mipmaps(const GlTexture& texture) const {
  bind_texture(gl_, 0, texture);
  gl_.GenerateMipmap(GL_TEXTURE_2D);
}

}  // namespace sprung
