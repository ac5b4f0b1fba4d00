#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/io/decode_image.h"
#include "render/image/color_map.h"
#include "render/stage/stage.h"

namespace sprung {

/// The pictures of textures, in linear light and without duplicates.
class TexturePictures {
 public:
  /// Null for an empty picture. Throws Error(kBadInput) if the picture cannot be decoded.
  [[nodiscard]] const Pixels* add(const SurfaceMaterial& material);

 private:
  struct Entry {
    const std::vector<std::byte>* source;
    std::unique_ptr<Pixels> pixels;
  };
  std::vector<Entry> entries_;
};

/// The colours of a skin, as surface.frag has them.
class SkinPaint {
 public:
  /// `default_color`: sRGB, if the skin has none of its own.
  SkinPaint(const Skin& skin, const Eigen::Vector3f& default_color, ColorMap map, TexturePictures& pictures);

  /// Linear, 0 to 1, in a triangle at the weights (sum 1) of its corners. `map_coordinates`: as in SkinShape.
  [[nodiscard]] Eigen::Vector3f color(int triangle, const Eigen::Vector3f& weights,
                                      const Eigen::VectorXf& map_coordinates) const;

 private:
  struct Paint {
    int first_triangle;
    Eigen::Vector3f color;  // linear
    const Pixels* texture;
  };
  [[nodiscard]] Eigen::Vector3f mapped(float coordinate) const;

  const Skin& skin_;
  std::vector<Eigen::Vector3f> map_;    // linear, evenly over the colour map
  std::vector<Eigen::Matrix3f> roots_;  // of the corners' colours (columns), by triangle: square root of linear, which
                                        // is interpolated; empty without such colours
  std::vector<Paint> paints_;           // by first triangle
};

}  // namespace sprung
