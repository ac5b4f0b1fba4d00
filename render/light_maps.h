#pragma once
#include <vector>

#include "render/ground_maps.h"

namespace sprung {

/// Everything that is drawn from the side of the light, before the picture: the light on the ground, and
/// - key: depth along the key light; soft shadows of the bodies on themselves and each other
/// - zenith: blurred heights seen from above; how much of the sky is open
class LightMaps {
 public:
  static constexpr int kUnits = 5;  // texture units that bind() takes

  LightMaps(const GlFunctions& gl, Quality quality);
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
            PassClock& clock) const;
  /// Binds the maps from unit `first_unit` on, and sets the uniforms with which a shader reads them.
  void bind(const GlProgram& program, const DrawFrame& frame, int first_unit) const;
  [[nodiscard]] const GlTexture& ground_tint() const { return ground_.tint(); }

 private:
  void blur_zenith(const DrawFrame& frame) const;

  const GlFunctions& gl_;
  MapBrush brush_;
  GlSampler shadow_sampler_;
  LightMap key_;
  LightMap zenith_depth_;
  LightMap zenith_;
  LightMap zenith_pass_;
  GlProgram zenith_program_;
  GroundMaps ground_;
};

}  // namespace sprung
