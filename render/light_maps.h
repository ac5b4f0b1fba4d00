#pragma once
#include <vector>

#include "render/frame.h"
#include "render/gl/draw_timer.h"
#include "render/skin_buffers.h"
#include "render/trace/ground_light.h"

namespace sprung {

/// A square render target.
struct LightMap {
  int size = 0;  // texels along a side
  GlTexture color;
  GlTexture depth;
  GlFramebuffer target;
};

/// llvmpipe reads bytes several times faster than half floats.
namespace map_format {
inline constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, false, false,
                                      GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kFlatColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, false, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kMask{GL_RG16, GL_RG, GL_UNSIGNED_SHORT, true, true, GL_CLAMP_TO_BORDER};
inline constexpr TextureFormat kFineColor{GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, false, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kShadow{GL_R8, GL_RED, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kMoments{GL_RG16, GL_RG, GL_UNSIGNED_SHORT, false, true, GL_CLAMP_TO_EDGE};
}  // namespace map_format

/// Draws into light maps.
class MapBrush {
 public:
  explicit MapBrush(const GlFunctions& gl);

  /// Without colours if `color` is null.
  [[nodiscard]] LightMap make_map(int size, const TextureFormat* color, bool depth) const;
  /// Runs the current program over the whole map.
  void fill(const LightMap& map) const;
  void clear(const LightMap& map) const;
  void make_mipmaps(const GlTexture& texture) const;
  /// Separable Gaussian via `scratch`, which is as large as `to`. `reach`: three standard deviations, in texture
  /// coordinates.
  void blur(const LightMap& from, const LightMap& scratch, const LightMap& to, const Eigen::Vector2f& reach) const;
  /// Depth of all bodies in a parallel projection.
  void draw_depth(const LightMap& map, const LightView& view, const std::vector<SkinBuffers>& skins, Detail detail,
                  const DrawFrame& frame) const;

 private:
  const GlFunctions& gl_;
  GlVertexArray no_buffers_;
  GlProgram depth_program_;
  GlProgram blur_program_;
};

/// Light on the rectangle of the ground where the bodies change it:
/// - sky: the fraction of the sky that bodies occlude, and the light that they reflect down instead
/// - shadow: the fraction of the key light that they occlude
/// - light: what the ground reflects, at low resolution; and blurred, for surfaces high above it
/// - tint: how much darker, or lighter, the floor looks
class GroundMaps {
 public:
  /// `key`: the depth map of the key light.
  GroundMaps(const GlFunctions& gl, const MapBrush& brush, const RenderOptions& options, const LightMap& key);
  /// Draws all but the tint.
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
            DrawTimer& clock) const;
  /// Draws the tint, with the bodies' effect on the ground if rays gather it.
  void draw_tint(const DrawFrame& frame, const GroundGlow* glow);

  void bind_glow(const GlProgram& program, int unit) const;
  [[nodiscard]] const GlTexture& sky() const { return sky_.color; }
  [[nodiscard]] const GlTexture& shadow() const { return shadow_.color; }
  [[nodiscard]] const GlTexture& light() const { return light_.color; }
  [[nodiscard]] const GlTexture& tint() const { return tint_.color; }
  [[nodiscard]] const GlTexture& far_light() const { return far_light_.color; }
  /// Reads back the light of a frame that was drawn.
  [[nodiscard]] GroundLight read_light(const DrawFrame& frame) const;

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
  LightMap far_light_scratch_;
  LightMap far_light_;
  LightMap tint_;
  GlTexture glow_;  // light from bodies, if it is gathered
  SkinPrograms underside_programs_;
  GlProgram underside_filter_program_;
  GlProgram sky_program_;
  GlProgram key_mask_program_;
  GlProgram shaded_program_;
  GlProgram shadow_program_;
  GlProgram light_program_;
  GlProgram tint_program_;
};

/// Everything that is rendered before the picture itself: the light on the ground, and
/// - key: depth along the key light, for soft shadows of the bodies on themselves and each other
/// - zenith: blurred heights seen from above, for the fraction of the sky that is visible, unless rays gather it
class LightMaps {
 public:
  static constexpr int kUnits = 5;  // texture units that bind() uses

  LightMaps(const GlFunctions& gl, const RenderOptions& options);
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const DrawFrame& frame,
            DrawTimer& clock) const;
  /// Binds the maps from unit `first_unit` on, and sets the uniforms with which a shader reads them.
  void bind(const GlProgram& program, const DrawFrame& frame, int first_unit) const;
  [[nodiscard]] const GroundMaps& ground() const { return ground_; }
  [[nodiscard]] GroundMaps& ground() { return ground_; }

 private:
  void blur_zenith(const DrawFrame& frame) const;

  const GlFunctions& gl_;
  bool has_zenith_;
  MapBrush brush_;
  GlSampler shadow_sampler_;
  GlSampler mean_sampler_;
  LightMap key_;
  LightMap zenith_depth_;
  LightMap zenith_;
  LightMap zenith_scratch_;
  GlProgram zenith_program_;
  GroundMaps ground_;
};

}  // namespace sprung
