#include "render/light_maps.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/shaders.h"

namespace sprung {

namespace {

constexpr int kZenithSize = 128;
constexpr int kZenithDepthSize = 2 * kZenithSize;
constexpr int kUndersideSize = 128;
constexpr int kUndersideColorSize = 2 * kUndersideSize;
constexpr int kGroundSkySize = 128;
constexpr int kGroundLightSize = 128;
constexpr float kShaded = 0.5F;       // depth of the ground where there may be shadow
constexpr float kZenithBlur = 0.45F;  // of a body's radius: three standard deviations

constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, false, false,
                               GL_CLAMP_TO_BORDER};
// llvmpipe reads 8 bits several times quicker than half floats.
constexpr TextureFormat kColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kMask{GL_RG8, GL_RG, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_BORDER};
constexpr TextureFormat kShadow{GL_R8, GL_RED, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
constexpr TextureFormat kLight{GL_RGBA16F, GL_RGBA, GL_FLOAT, true, true, GL_CLAMP_TO_EDGE};
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

Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides) {
  Eigen::Vector4f values;
  values << low.cast<float>(), sides.cast<float>();
  return values;
}

/// How far it is from the highest body to the ground along the key light; an upper bound.
double longest_way(const DrawFrame& frame) {
  return std::max(frame.light.bodies.high.y() - frame.ground_height, 1e-3 * frame.body_radius) / to_key_light().y();
}

/// Low corner and one over the sides, in x and z, of a view that looks up or down.
Eigen::Vector4f lookup_rectangle(const LightView& view) {
  return rectangle(view.low.head<2>(), view.sides.head<2>().cwiseInverse());
}

/// Texels along the key light's map.
int key_size(Quality quality) { return quality == Quality::kHigh ? 2048 : quality == Quality::kDefault ? 1024 : 512; }

std::string shadow_settings(Quality quality) {
  const bool is_high = quality == Quality::kHigh;
  return fmt::format("#define SHADED {:.3f}\n#define SEARCH {}\n#define TAPS {}\n", kShaded, is_high ? 12 : 6,
                     is_high ? 32 : 14);
}

std::string light_settings(int ground_shadow_size) {
  return fmt::format("#define SHADOW_LOD {:.3f}\n", std::log2(ground_shadow_size / kGroundLightSize));
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

LightMaps::LightMaps(const GlFunctions& gl, Quality quality)
    : gl_(gl),
      key_size_(key_size(quality)),
      key_mask_size_(key_size_ / 2),
      ground_shadow_size_(key_size_ / 2),
      no_buffers_(make_vertex_array(gl)),
      shadow_sampler_(make_comparing_sampler(gl, GL_LEQUAL)),
      flat_sampler_(make_flat_sampler(gl)),
      key_(make_map(gl, key_size_, nullptr, true)),
      key_mask_(make_map(gl, key_mask_size_, &kMask, false)),
      zenith_depth_(make_map(gl, kZenithDepthSize, nullptr, true)),
      zenith_(make_map(gl, kZenithSize, &kMoments, false)),
      zenith_pass_(make_map(gl, kZenithSize, &kMoments, false)),
      underside_color_(make_map(gl, kUndersideColorSize, &kColor, true)),
      underside_(make_map(gl, kUndersideSize, &kMask, false)),
      ground_sky_(make_map(gl, kGroundSkySize, &kFlat, false)),
      ground_shadow_(make_map(gl, ground_shadow_size_, &kShadow, true)),
      ground_light_(make_map(gl, kGroundLightSize, &kLight, false)),
      depth_program_(load_program(gl, "depth.vert", "depth.frag")),
      zenith_program_(load_program(gl, "screen.vert", "zenith_filter.frag")),
      blur_program_(load_program(gl, "screen.vert", "blur.frag")),
      underside_programs_(load_skin_programs(gl, "underside.frag")),
      underside_filter_program_(load_program(gl, "screen.vert", "underside_filter.frag")),
      ground_sky_program_(load_program(gl, "screen.vert", "ground_sky.frag")),
      key_mask_program_(load_program(gl, "screen.vert", "key_mask.frag")),
      shaded_ground_program_(load_program(gl, "screen.vert", "ground_shadow.frag", shadow_settings(quality))),
      ground_shadow_program_(
          load_program(gl, "screen.vert", "ground_shadow.frag", shadow_settings(quality) + "#define SHADOW\n")),
      ground_light_program_(load_program(gl, "screen.vert", "ground_light.frag", light_settings(ground_shadow_size_))) {
}

void LightMaps::draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
                     PassClock& clock) {
  gl_.Enable(GL_DEPTH_TEST);
  draw_depth(key_, key_size_, frame.light.key, skins, frame);
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
    draw_ground_shadow(frame);
    clock.stop("ground shadow");
  } else {  // a floor far below, which nothing shades
    clear(ground_sky_, kGroundSkySize);
    clear(ground_shadow_, ground_shadow_size_);
    make_mipmaps(ground_shadow_.color);
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
  for (const SkinBuffers& skin : skins) {
    if (!skin.is_ghost()) skin.draw(Detail::kCoarse);
  }
}

void LightMaps::draw_underside(const std::vector<SkinBuffers>& skins, const TextureSet& textures,
                               const DrawFrame& frame) const {
  clear(underside_color_, kUndersideColorSize);
  for (const GlProgram* program :
       {&underside_programs_.plain, &underside_programs_.textured, &underside_programs_.mapped}) {
    program->use();
    frame.set_common(*program);
    program->set("clip_from_stage", frame.light.nadir.clip_from_stage.cast<float>().eval());
  }
  for (const SkinBuffers& skin : skins) {
    if (!skin.is_ghost()) skin.draw(underside_programs_, textures, 0, Detail::kCoarse);
  }
  make_mipmaps(underside_color_.color);

  underside_filter_program_.use();
  bind_texture(gl_, 0, underside_color_.depth);
  underside_filter_program_.set("underside_depth", 0);
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
  const LightView& nadir = frame.light.nadir;
  program.set("underside_heights",
              Eigen::Vector2d(nadir.low.z() - frame.ground_height, nadir.sides.z()).cast<float>().eval());
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
  key_mask_program_.set("longest_way", static_cast<float>(longest_way(frame)));
  key_mask_program_.set("height_from_light", height.cast<float>().eval());
  bind_texture(gl_, 0, key_.depth);
  key_mask_program_.set("key_depth", 0);
  fill(key_mask_, key_mask_size_);
  make_mipmaps(key_mask_.color);
}

/// First, in the depth, where there may be shadow. There it is looked for: an early depth test keeps llvmpipe from
/// running the costly shader elsewhere.
void LightMaps::draw_ground_shadow(const DrawFrame& frame) const {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_ALWAYS);
  draw_ground_shadow(shaded_ground_program_, frame);
  gl_.DepthFunc(GL_EQUAL);
  draw_ground_shadow(ground_shadow_program_, frame);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_DEPTH_TEST);
  make_mipmaps(ground_shadow_.color);
}

void LightMaps::draw_ground_shadow(const GlProgram& program, const DrawFrame& frame) const {
  program.use();
  frame.set_common(program);
  const Eigen::Vector2f sides = frame.light.key.sides.head<2>().cast<float>();
  program.set("mask_texels", static_cast<float>(key_mask_size_) / sides.x());
  program.set("mask_texel_size", (Eigen::Vector2f(1, sides.x() / sides.y()) / key_mask_size_).eval());
  program.set("longest_way", static_cast<float>(longest_way(frame)));
  bind_texture(gl_, 0, key_mask_.color);
  program.set("key_mask", 0);
  program.set("screen_depth", kShaded);
  fill(ground_shadow_, ground_shadow_size_);
}

void LightMaps::draw_ground_light(const DrawFrame& frame) const {
  ground_light_program_.use();
  frame.set_common(ground_light_program_);
  bind_texture(gl_, 0, ground_sky_.color);
  ground_light_program_.set("ground_sky", 0);
  bind_texture(gl_, 1, ground_shadow_.color);
  ground_light_program_.set("ground_shadow", 1);
  fill(ground_light_, kGroundLightSize);
  make_mipmaps(ground_light_.color);
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
  program.set("ground_light_map", first_unit + 3);
}

void LightMaps::bind_ground(const GlProgram& program, const DrawFrame& frame, int first_unit) const {
  frame.set_common(program);
  bind_texture(gl_, first_unit, ground_sky_.color);
  program.set("ground_sky", first_unit);
  bind_texture(gl_, first_unit + 1, ground_shadow_.color, flat_sampler_.name());
  program.set("ground_shadow", first_unit + 1);
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
