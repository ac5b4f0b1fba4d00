#pragma once
#include <vector>

#include "render/gl/objects.h"
#include "render/light_frame.h"
#include "render/pass_clock.h"
#include "render/skin_buffers.h"

namespace sprung {

/// What the shaders share within one frame.
struct DrawFrame {
  StageSpace space;
  LightFrame light;
  double body_radius;    // of the largest body, stage space
  double ground_height;  // stage space
  bool has_ground;

  /// Sets the uniforms that every program with a skin or a light map knows.
  void set_common(const GlProgram& program) const;
};

/// A texture to draw into.
struct LightMap {
  GlTexture color;
  GlTexture depth;
  GlFramebuffer target;
};

/// Everything that is drawn from the side of the light, before the picture:
/// - key: depth along the key light; soft shadows of the bodies on themselves and each other
/// - zenith: blurred heights seen from above; how much of the sky is open
/// - ground sky, ground shadow: what the bodies hide of the sky and of the key light from the ground, by place
/// - ground light: what the ground sends back, coarsely
class LightMaps {
 public:
  static constexpr int kUnits = 4;  // texture units that bind() takes

  LightMaps(const GlFunctions& gl, Quality quality);
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
            PassClock& clock);
  /// Binds the maps from unit `first_unit` on, and sets the uniforms with which a shader reads them.
  void bind(const GlProgram& program, const DrawFrame& frame, int first_unit) const;
  /// The same for what the floor needs; two units.
  void bind_ground(const GlProgram& program, const DrawFrame& frame, int first_unit) const;

 private:
  void draw_depth(const LightMap& map, int size, const LightView& view, const std::vector<SkinBuffers>& skins,
                  const DrawFrame& frame) const;
  void draw_underside(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame) const;
  void draw_ground_sky(const DrawFrame& frame) const;
  void draw_key_mask(const DrawFrame& frame) const;
  void draw_ground_shadow(const DrawFrame& frame) const;
  void draw_ground_shadow(const GlProgram& program, const DrawFrame& frame) const;
  void draw_ground_light(const DrawFrame& frame) const;
  void blur_zenith(const DrawFrame& frame) const;
  void fill(const LightMap& map, int size) const;
  void clear(const LightMap& map, int size) const;
  void make_mipmaps(const GlTexture& texture) const;

  const GlFunctions& gl_;
  int key_size_;  // texels along a side
  int key_mask_size_;
  int ground_shadow_size_;
  GlVertexArray no_buffers_;
  GlSampler shadow_sampler_;
  GlSampler flat_sampler_;
  LightMap key_;
  LightMap key_mask_;
  LightMap zenith_depth_;
  LightMap zenith_;
  LightMap zenith_pass_;
  LightMap underside_color_;
  LightMap underside_;
  LightMap ground_sky_;
  LightMap ground_shadow_;
  LightMap ground_light_;
  GlProgram depth_program_;
  GlProgram zenith_program_;
  GlProgram blur_program_;
  SkinPrograms underside_programs_;
  GlProgram underside_filter_program_;
  GlProgram ground_sky_program_;
  GlProgram key_mask_program_;
  GlProgram shaded_ground_program_;
  GlProgram ground_shadow_program_;
  GlProgram ground_light_program_;
};

}  // namespace sprung
