#include "render/light_maps.h"

#include "render/shaders.h"

namespace sprung {

namespace {

constexpr int kZenithSize = 128;
constexpr int kZenithDepthSize = 2 * kZenithSize;
constexpr double kZenithBlur = 0.45;  // of a body's radius: three standard deviations

/// Texels along the key light's map.
int key_size(Quality quality) { return quality == Quality::kHigh ? 2048 : quality == Quality::kDefault ? 768 : 512; }

}  // namespace

LightMaps::LightMaps(const GlFunctions& gl, Quality quality)
    : gl_(gl),
      brush_(gl),
      shadow_sampler_(make_comparing_sampler(gl, GL_LEQUAL)),
      key_(brush_.make_map(key_size(quality), nullptr, true)),
      zenith_depth_(brush_.make_map(kZenithDepthSize, nullptr, true)),
      zenith_(brush_.make_map(kZenithSize, &map_format::kMoments, false)),
      zenith_pass_(brush_.make_map(kZenithSize, &map_format::kMoments, false)),
      zenith_program_(load_program(gl, "screen.vert", "zenith_filter.frag")),
      ground_(gl, brush_, quality, key_) {}

void LightMaps::draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
                     PassClock& clock) const {
  gl_.Enable(GL_DEPTH_TEST);
  brush_.draw_depth(key_, frame.light.key, skins, Detail::kCoarse, frame);
  clock.stop("key map");
  brush_.draw_depth(zenith_depth_, frame.light.zenith, skins, Detail::kCoarsest, frame);
  gl_.Disable(GL_DEPTH_TEST);
  clock.stop("zenith map");
  blur_zenith(frame);
  clock.stop("zenith blur");
  ground_.draw(skins, textures, frame, clock);
}

void LightMaps::blur_zenith(const DrawFrame& frame) const {
  zenith_program_.use();
  bind_texture(gl_, 0, zenith_depth_.depth);
  zenith_program_.set("zenith_depth", 0);
  brush_.fill(zenith_);
  const Eigen::Array2d reach = kZenithBlur * frame.body_radius / frame.light.zenith.sides.head<2>().array();
  brush_.blur(zenith_, zenith_pass_, zenith_, reach.cast<float>());
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
  bind_texture(gl_, first_unit, key_.depth, shadow_sampler_.name());
  program.set("key_shadow_map", first_unit);
  bind_texture(gl_, first_unit + 1, key_.depth);
  program.set("key_depth", first_unit + 1);
  bind_texture(gl_, first_unit + 2, zenith_.color);
  program.set("zenith", first_unit + 2);
  bind_texture(gl_, first_unit + 3, ground_.light());
  program.set("ground_light_map", first_unit + 3);
  bind_texture(gl_, first_unit + 4, ground_.far_light());
  program.set("far_ground_light_map", first_unit + 4);
}

}  // namespace sprung
