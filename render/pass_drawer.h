#pragma once
#include <array>
#include <vector>

#include "render/frame.h"
#include "render/image/image.h"
#include "render/skin_buffers.h"

namespace sprung {

/// A frame as its camera sees it, and the views of the cameras one frame earlier and later.
struct PassViews {
  View now;
  Camera camera;  // that `now` was made with
  View before;
  View after;
};

/// Draws the Passes of a picture.
class PassDrawer {
 public:
  PassDrawer(const GlFunctions& gl, int width, int height);
  /// `ids`: one per skin.
  [[nodiscard]] Passes draw(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids,
                            const PassViews& views) const;

 private:
  static constexpr std::size_t kTextures = 4;

  void draw_skins(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view) const;
  void read(const PassViews& views, Passes& passes) const;
  void find_coverage(const std::vector<SkinBuffers>& skins, const std::vector<int>& ids, const View& view,
                     Passes& passes) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  std::array<GlTexture, kTextures> numbers_;  // as in passes.frag; in stage space, normals of any length
  GlTexture depth_;
  GlFramebuffer target_;
  GlProgram program_;
};

}  // namespace sprung
