#pragma once
#include <vector>

#include "render/map_brush.h"
#include "render/pass_clock.h"

namespace sprung {

/// The light on the ground by place, in the rectangle of it on which the bodies change it:
/// - sky: how much of the sky the bodies hide, and the light they send down instead
/// - shadow: how much of the key light they hide
/// - light: what the ground sends back, coarsely; and blurred, for what is high above it
/// - tint: how much darker the floor looks
class GroundMaps {
 public:
  /// `key`: the map of depths along the key light.
  GroundMaps(const GlFunctions& gl, const MapBrush& brush, Quality quality, const LightMap& key);
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
            PassClock& clock) const;

  [[nodiscard]] const GlTexture& light() const { return light_.color; }
  [[nodiscard]] const GlTexture& tint() const { return tint_.color; }
  [[nodiscard]] const GlTexture& far_light() const { return far_light_.color; }

 private:
  void draw_underside(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame) const;
  void draw_sky(const DrawFrame& frame) const;
  void draw_key_mask(const DrawFrame& frame) const;
  void draw_shadow(const DrawFrame& frame) const;
  void draw_shadow(const GlProgram& program, const DrawFrame& frame) const;
  void draw_light(const GlProgram& program, const LightMap& map, const DrawFrame& frame) const;

  const GlFunctions& gl_;
  const MapBrush& brush_;
  const LightMap& key_;
  LightMap key_mask_;
  LightMap underside_color_;
  LightMap underside_;
  LightMap sky_;
  LightMap shadow_;
  LightMap light_;
  LightMap far_light_pass_;
  LightMap far_light_;
  LightMap tint_;
  SkinPrograms underside_programs_;
  GlProgram underside_filter_program_;
  GlProgram sky_program_;
  GlProgram key_mask_program_;
  GlProgram shaded_program_;
  GlProgram shadow_program_;
  GlProgram light_program_;
  GlProgram tint_program_;
};

}  // namespace sprung
