#pragma once
#include <vector>

#include "render/frame.h"
#include "render/image/image.h"
#include "render/skin_buffers.h"

namespace sprung {

/// Draws the Passes of a picture.
class PassDrawer {
 public:
  PassDrawer(const GlFunctions& gl, int width, int height);
  /// `ids`: one per skin. `camera`: the one that `view` was made with.
  [[nodiscard]] Passes draw(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view,
                            const Camera& camera) const;

 private:
  void draw_skins(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view) const;
  void read(const View& view, const Camera& camera, Passes& passes) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  GlTexture place_;   // in stage space; id
  GlTexture normal_;  // of any length
  GlTexture depth_;
  GlFramebuffer target_;
  GlProgram program_;
};

}  // namespace sprung
