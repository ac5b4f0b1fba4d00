#pragma once
#include <vector>

#include "render/view.h"

namespace sprung {

/// Draws what a camera sees, once the light maps are done: first what the skins are in every sample of every pixel,
/// then the picture that is developed from it.
class Screen {
 public:
  Screen(const GlFunctions& gl, const RenderOptions& options);
  void draw(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const LightMaps& maps, const View& view,
            PassClock& clock) const;
  [[nodiscard]] Image read() const;
  [[nodiscard]] double aspect() const { return static_cast<double>(width_) / height_; }

 private:
  [[nodiscard]] GlProgram load(const char* fragment, const char* defines) const;
  void draw_surfaces(const std::vector<SkinBuffers>& skins, const TextureSet& textures, const View& view) const;
  void sort_pixels(const LightMaps& maps, const View& view) const;
  void develop(const LightMaps& maps, const View& view, PassClock& clock) const;
  void cover(const GlProgram& program, float depth, const LightMaps& maps, const View& view) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  int side_;  // of a pixel, in samples
  GlTexture surface_color_;
  GlTexture surface_normal_;
  GlTexture surface_depth_;
  GlFramebuffer surface_;
  GlTexture picture_;  // its top row first
  GlTexture kinds_;    // of pixels, as depths
  GlFramebuffer developed_;
  GlVertexArray no_buffers_;
  SkinPrograms surface_programs_;
  GlProgram kinds_program_;
  GlProgram surroundings_program_;
  GlProgram inside_program_;
  GlProgram edge_program_;
};

}  // namespace sprung
