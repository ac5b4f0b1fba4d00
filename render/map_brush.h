#pragma once
#include <vector>

#include "render/draw_frame.h"
#include "render/skin_buffers.h"

namespace sprung {

/// A square texture to draw into.
struct LightMap {
  int size = 0;  // texels along a side
  GlTexture color;
  GlTexture depth;
  GlFramebuffer target;
};

/// Formats of maps. llvmpipe reads bytes several times quicker than half floats.
namespace map_format {
inline constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, false, false,
                                      GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kFlatColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, false, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kMask{GL_RG8, GL_RG, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_BORDER};
inline constexpr TextureFormat kShadow{GL_R8, GL_RED, GL_UNSIGNED_BYTE, true, true, GL_CLAMP_TO_EDGE};
inline constexpr TextureFormat kMoments{GL_RG32F, GL_RG, GL_FLOAT, false, true, GL_CLAMP_TO_EDGE};
}  // namespace map_format

/// Draws into light maps.
class MapBrush {
 public:
  explicit MapBrush(const GlFunctions& gl);

  /// Without colours where `color` is null.
  [[nodiscard]] LightMap make_map(int size, const TextureFormat* color, bool depth) const;
  /// The program in use over all of the map.
  void fill(const LightMap& map) const;
  void clear(const LightMap& map) const;
  void make_mipmaps(const GlTexture& texture) const;
  /// Gaussian along both axes, by way of `pass`, which is as large as `to`. `reach`: three standard deviations, in
  /// texture coordinates.
  void blur(const LightMap& from, const LightMap& pass, const LightMap& to, const Eigen::Vector2f& reach) const;
  /// The depths of all bodies, seen in parallel lines.
  void draw_depth(const LightMap& map, const LightView& view, const std::vector<SkinBuffers>& skins, Detail detail,
                  const DrawFrame& frame) const;

 private:
  const GlFunctions& gl_;
  GlVertexArray no_buffers_;
  GlProgram depth_program_;
  GlProgram blur_program_;
};

}  // namespace sprung
