#include "render/light_maps.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "render/shaders.h"

namespace sprung {
namespace {

/// Nothing beyond the map.
void set_border(const GlFunctions& gl) {
  const std::array<float, 4> border{};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border.data());
}

}  // namespace

MapBrush::MapBrush(const GlFunctions& gl)
    : gl_(gl),
      no_buffers_(make_vertex_array(gl)),
      depth_program_(load_program(gl, "depth.vert", "depth.frag")),
      blur_program_(load_program(gl, "screen.vert", "blur.frag")) {}

LightMap MapBrush::make_map(int size, const TextureFormat* color, bool depth) const {
  LightMap map;
  map.size = size;
  if (color != nullptr) {
    map.color = make_texture(gl_, size, size, *color);
    set_border(gl_);
  }
  if (depth) map.depth = make_texture(gl_, size, size, map_format::kDepth);
  map.target = make_texture_target(gl_, color != nullptr ? &map.color : nullptr, depth ? &map.depth : nullptr);
  return map;
}

void MapBrush::fill(const LightMap& map) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, map.size, map.size);
  gl_.BindVertexArray(no_buffers_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void MapBrush::clear(const LightMap& map) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.target.name());
  gl_.Viewport(0, 0, map.size, map.size);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void MapBrush::make_mipmaps(const GlTexture& texture) const {
  bind_texture(gl_, 0, texture);
  gl_.GenerateMipmap(GL_TEXTURE_2D);
}

void MapBrush::blur(const LightMap& from, const LightMap& scratch, const LightMap& to,
                    const Eigen::Vector2f& reach) const {
  blur_program_.use();
  blur_program_.set("source", 0);
  bind_texture(gl_, 0, from.color);
  blur_program_.set("reach", Eigen::Vector2f(reach.x(), 0));
  fill(scratch);
  bind_texture(gl_, 0, scratch.color);
  blur_program_.set("reach", Eigen::Vector2f(0, reach.y()));
  fill(to);
}

void MapBrush::draw_depth(const LightMap& map, const LightView& view, const std::vector<SkinBuffers>& skins,
                          Detail detail, const DrawFrame& frame) const {
  clear(map);
  depth_program_.use();
  frame.set_common(depth_program_);
  depth_program_.set("clip_from_stage", view.clip_from_stage.cast<float>().eval());
  for (const SkinBuffers& skin : skins) {
    if (skin.casts_shadows()) skin.draw(detail);
  }
}

namespace {

constexpr int kUndersideSize = 128;
constexpr int kUndersideColorSize = 2 * kUndersideSize;
constexpr int kSkySize = 96;
constexpr int kLightSize = 128;
constexpr int kFarLightSize = 32;
constexpr double kFarBlur = 0.75;  // of a body's radius: three standard deviations
constexpr float kBrightestGlow = 4;
constexpr float kShaded = 0.5F;  // depth of the ground that may be in shadow

/// An upper bound of the distance from the highest body to the ground along the key light.
double longest_way(const DrawFrame& frame) {
  return std::max(frame.light.bodies.max().y() - frame.ground_height, 1e-3 * frame.body_radius) /
         frame.lighting.to_key().y();
}

/// Texels along the ground's shadow, which is soft.
int shadow_size(Quality quality) { return quality == Quality::kHigh ? 640 : quality == Quality::kDefault ? 384 : 192; }

std::string shadow_settings(Quality quality) {
  const bool is_high = quality == Quality::kHigh;
  return fmt::format("#define SHADED {:.3f}\n#define RINGS {}\n#define DIRECTIONS {}\n", kShaded, is_high ? 8 : 6,
                     is_high ? 7 : 5);
}

std::string tint_defines(const RenderOptions& options) {
  return std::string(options.exposes ? "#define EXPOSURE\n" : "") + (options.gathers_light ? "#define GATHERED\n" : "");
}

std::string light_settings(int shadow_size) {
  return fmt::format("#define SHADOW_LOD {:.3f}\n", std::log2(double(shadow_size) / kLightSize));
}

}  // namespace

GroundMaps::GroundMaps(const GlFunctions& gl, const MapBrush& brush, const RenderOptions& options, const LightMap& key)
    : gl_(gl),
      brush_(brush),
      key_(key),
      key_mask_(brush.make_map(key.size / 2, &map_format::kMask, false)),
      underside_color_(brush.make_map(kUndersideColorSize, &map_format::kColor, true)),
      underside_(brush.make_map(kUndersideSize, &map_format::kMask, false)),
      sky_(brush.make_map(kSkySize, &map_format::kFlatColor, false)),
      shadow_(brush.make_map(shadow_size(options.quality), &map_format::kShadow, true)),
      light_(brush.make_map(kLightSize, &map_format::kFlatColor, false)),
      far_light_scratch_(brush.make_map(kFarLightSize, &map_format::kFlatColor, false)),
      far_light_(brush.make_map(kFarLightSize, &map_format::kFlatColor, false)),
      tint_(brush.make_map(shadow_.size, &map_format::kFineColor, false)),
      underside_programs_(load_skin_programs(gl, "underside.frag")),
      underside_filter_program_(load_program(gl, "screen.vert", "underside_filter.frag")),
      sky_program_(load_program(gl, "screen.vert", "ground_sky.frag")),
      key_mask_program_(load_program(gl, "screen.vert", "key_mask.frag")),
      shaded_program_(load_program(gl, "screen.vert", "ground_shadow.frag", shadow_settings(options.quality))),
      shadow_program_(
          load_program(gl, "screen.vert", "ground_shadow.frag", shadow_settings(options.quality) + "#define SHADOW\n")),
      light_program_(load_program(gl, "screen.vert", "ground_light.frag", light_settings(shadow_.size))),
      tint_program_(load_program(gl, "screen.vert", "ground_tint.frag", tint_defines(options))) {}

void GroundMaps::draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
                      DrawTimer& clock) const {
  if (frame.has_ground) {
    draw_underside(skins, textures, frame);
    clock.stop("underside map");
    draw_sky(frame);
    clock.stop("ground sky");
    draw_key_mask(frame);
    clock.stop("key mask");
    draw_shadow(frame);
    clock.stop("ground shadow");
  } else {  // a floor far below, without shadows
    brush_.clear(sky_);
    brush_.clear(shadow_);
    brush_.make_mipmaps(shadow_.color);
  }
  draw_light(light_program_, light_, frame);
  const Eigen::Array2d reach = kFarBlur * frame.body_radius / frame.light.ground.sides.array();
  brush_.blur(light_, far_light_scratch_, far_light_, reach.cast<float>());
  clock.stop("ground light");
}

void GroundMaps::draw_underside(const std::vector<SkinBuffers>& skins, const TextureSet& textures,
                                const DrawFrame& frame) const {
  gl_.Enable(GL_DEPTH_TEST);
  brush_.clear(underside_color_);
  for (const GlProgram* program :
       {&underside_programs_.plain, &underside_programs_.textured, &underside_programs_.mapped}) {
    program->use();
    frame.set_common(*program);
    program->set("clip_from_stage", frame.light.nadir.clip_from_stage.cast<float>().eval());
  }
  for (const SkinBuffers& skin : skins) {
    if (skin.casts_shadows()) skin.draw(underside_programs_, textures, 0, Detail::kCoarsest);
  }
  gl_.Disable(GL_DEPTH_TEST);
  brush_.make_mipmaps(underside_color_.color);

  underside_filter_program_.use();
  bind_texture(gl_, 0, underside_color_.depth);
  underside_filter_program_.set("underside_depth", 0);
  brush_.fill(underside_);
  brush_.make_mipmaps(underside_.color);
}

void GroundMaps::draw_sky(const DrawFrame& frame) const {
  const LightView& nadir = frame.light.nadir;
  sky_program_.use();
  frame.set_common(sky_program_);
  sky_program_.set("underside_rectangle", lookup_rectangle(nadir));
  sky_program_.set("underside_heights",
                   Eigen::Vector2d(nadir.low.z() - frame.ground_height, nadir.sides.z()).cast<float>().eval());
  sky_program_.set("underside_texels", float(kUndersideSize));
  bind_texture(gl_, 0, underside_.color);
  sky_program_.set("underside", 0);
  bind_texture(gl_, 1, underside_color_.color);
  sky_program_.set("underside_color", 1);
  brush_.fill(sky_);
}

void GroundMaps::draw_key_mask(const DrawFrame& frame) const {
  const LightView& key = frame.light.key;
  // Clip coordinates are 2 (u, v, depth) - 1; the row of the inverse that gives y, less the ground's height.
  const Eigen::RowVector4d y = key.clip_from_stage.inverse().row(1);
  const Eigen::Vector4d height(2 * y[0], 2 * y[1], 2 * y[2], y[3] - y[0] - y[1] - y[2] - frame.ground_height);
  key_mask_program_.use();
  frame.set_common(key_mask_program_);
  key_mask_program_.set("longest_way", float(longest_way(frame)));
  key_mask_program_.set("height_from_light", height.cast<float>().eval());
  bind_texture(gl_, 0, key_.depth);
  key_mask_program_.set("key_depth", 0);
  brush_.fill(key_mask_);
  brush_.make_mipmaps(key_mask_.color);
}

/// The first pass marks in the depth buffer where there may be shadow; the early depth test then keeps llvmpipe from
/// running the expensive shader elsewhere.
void GroundMaps::draw_shadow(const DrawFrame& frame) const {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_ALWAYS);
  draw_shadow(shaded_program_, frame);
  gl_.DepthFunc(GL_EQUAL);
  draw_shadow(shadow_program_, frame);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_DEPTH_TEST);
  brush_.make_mipmaps(shadow_.color);
}

void GroundMaps::draw_shadow(const GlProgram& program, const DrawFrame& frame) const {
  program.use();
  frame.set_common(program);
  const Eigen::Vector2f sides = frame.light.key.sides.head<2>().cast<float>();
  program.set("mask_texels", float(key_mask_.size) / sides.x());
  program.set("mask_texel_size", (Eigen::Vector2f(1, sides.x() / sides.y()) / key_mask_.size).eval());
  program.set("longest_way", float(longest_way(frame)));
  bind_texture(gl_, 0, key_mask_.color);
  program.set("key_mask", 0);
  program.set("screen_depth", kShaded);
  brush_.fill(shadow_);
}

void GroundMaps::draw_light(const GlProgram& program, const LightMap& map, const DrawFrame& frame) const {
  program.use();
  frame.set_common(program);
  bind_texture(gl_, 0, sky_.color);
  program.set("ground_sky", 0);
  bind_texture(gl_, 1, shadow_.color);
  program.set("ground_shadow", 1);
  brush_.fill(map);
}

void GroundMaps::draw_tint(const DrawFrame& frame, const GroundGlow* glow) {
  if (!frame.has_ground) return;
  tint_program_.use();
  if (glow != nullptr) {
    std::vector<std::uint16_t> texels;
    for (const Eigen::Vector4f& texel : glow->texels) {
      Eigen::Array4f stored = texel;
      stored.head<3>() = (stored.head<3>() / kBrightestGlow).sqrt();
      for (const float part : stored.min(1.0F)) texels.push_back(static_cast<std::uint16_t>(std::lround(65535 * part)));
    }
    glow_ = make_texture(gl_, glow->size, glow->size, map_format::kFineColor, texels.data());
    bind_glow(tint_program_, 2);
  }
  draw_light(tint_program_, tint_, frame);
}

void GroundMaps::bind_glow(const GlProgram& program, int unit) const {
  bind_texture(gl_, unit, glow_);
  program.set("ground_glow", unit);
  program.set("brightest_glow", kBrightestGlow);
}

GroundLight GroundMaps::read_light(const DrawFrame& frame) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, light_.target.name());
  std::vector<std::uint8_t> bytes(4 * std::size_t(light_.size) * std::size_t(light_.size));
  gl_.ReadPixels(0, 0, light_.size, light_.size, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  GroundLight light{frame.ground_height,
                    frame.light.ground.low.cast<float>(),
                    frame.light.ground.sides.cast<float>(),
                    light_.size,
                    {}};
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    light.texels.emplace_back(2 * Eigen::Vector3f(bytes[i], bytes[i + 1], bytes[i + 2]) / 255);  // the map has half
  }
  return light;
}

namespace {

constexpr int kZenithSize = 128;
constexpr int kZenithDepthSize = 2 * kZenithSize;
constexpr double kZenithBlur = 0.45;  // of a body's radius: three standard deviations

/// Texels along the key light's map.
int key_size(Quality quality) { return quality == Quality::kHigh ? 2048 : quality == Quality::kDefault ? 768 : 384; }

}  // namespace

LightMaps::LightMaps(const GlFunctions& gl, const RenderOptions& options)
    : gl_(gl),
      has_zenith_(!options.gathers_light),
      brush_(gl),
      shadow_sampler_(make_comparing_sampler(gl, GL_LEQUAL, true)),
      mean_sampler_(make_level_sampler(gl)),
      key_(brush_.make_map(key_size(options.quality), nullptr, true)),
      zenith_depth_(brush_.make_map(kZenithDepthSize, nullptr, true)),
      zenith_(brush_.make_map(kZenithSize, &map_format::kMoments, false)),
      zenith_scratch_(brush_.make_map(kZenithSize, &map_format::kMoments, false)),
      zenith_program_(load_program(gl, "screen.vert", "zenith_filter.frag")),
      ground_(gl, brush_, options, key_) {}

void LightMaps::draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
                     DrawTimer& clock) const {
  gl_.Enable(GL_DEPTH_TEST);
  brush_.draw_depth(key_, frame.light.key, skins, Detail::kCoarse, frame);
  brush_.make_mipmaps(key_.depth);
  clock.stop("key map");
  if (has_zenith_) brush_.draw_depth(zenith_depth_, frame.light.zenith, skins, Detail::kCoarsest, frame);
  gl_.Disable(GL_DEPTH_TEST);
  clock.stop("zenith map");
  if (has_zenith_) blur_zenith(frame);
  clock.stop("zenith blur");
  ground_.draw(skins, textures, frame, clock);
}

void LightMaps::blur_zenith(const DrawFrame& frame) const {
  zenith_program_.use();
  bind_texture(gl_, 0, zenith_depth_.depth);
  zenith_program_.set("zenith_depth", 0);
  brush_.fill(zenith_);
  const Eigen::Array2d reach = kZenithBlur * frame.body_radius / frame.light.zenith.sides.head<2>().array();
  brush_.blur(zenith_, zenith_scratch_, zenith_, reach.cast<float>());
}

void LightMaps::bind(const GlProgram& program, const DrawFrame& frame, int first_unit) const {
  const LightView& key = frame.light.key;
  const LightView& zenith = frame.light.zenith;
  frame.set_common(program);
  program.set("light_texel", Eigen::Vector2f(key.sides.head<2>().cwiseInverse().cast<float>()));
  program.set("key_depth_range", float(key.sides.z()));
  program.set("zenith_rectangle", lookup_rectangle(zenith));
  program.set("zenith_heights", Eigen::Vector2f(-zenith.low.z() - zenith.sides.z(), float(1 / zenith.sides.z())));
  bind_texture(gl_, first_unit, key_.depth, shadow_sampler_.name());
  program.set("key_shadow_map", first_unit);
  bind_texture(gl_, first_unit + 1, key_.depth, mean_sampler_.name());
  program.set("key_depth", first_unit + 1);
  bind_texture(gl_, first_unit + 2, zenith_.color);
  program.set("zenith", first_unit + 2);
  bind_texture(gl_, first_unit + 3, ground_.light());
  program.set("ground_light_map", first_unit + 3);
  bind_texture(gl_, first_unit + 4, ground_.far_light());
  program.set("far_ground_light_map", first_unit + 4);
}

}  // namespace sprung
