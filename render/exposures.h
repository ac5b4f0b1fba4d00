#pragma once
#include <vector>

#include "render/gl/objects.h"

namespace sprung {

/// The mean light of several exposures and its picture.
class Exposures {
 public:
  Exposures(const GlFunctions& gl, int width, int height, bool transparent);
  /// To be called before the first exposure.
  void clear() const;
  /// `light`: linear; the parts of all exposures add up to 1.
  void add(const GlTexture& light, double part) const;
  /// The same through a lens; `circles`: of confusion, see circles.frag; `largest`: the largest one considered.
  void add(const GlTexture& light, const GlTexture& circles, double largest, double part) const;
  /// Instead of clear() and add(): the mean light by pixel, as mean() has it.
  void set_mean(const std::vector<Eigen::Vector4f>& light);
  /// Framebuffer of the mean light, red, green, blue and opacity, premultiplied if transparent.
  [[nodiscard]] GLuint mean() const { return mean_target_.name(); }
  /// Writes the picture, 8-bit sRGB, to the bound framebuffer.
  void develop() const;

 private:
  void cover(const GlProgram& program, const GlTexture& source, const GlFramebuffer& target) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  GlTexture mean_;
  GlFramebuffer mean_target_;
  GlTexture picture_;
  GlFramebuffer picture_target_;
  GlVertexArray no_buffers_;
  GlProgram add_program_;
  GlProgram lens_program_;
  GlProgram develop_program_;
};

}  // namespace sprung
