#pragma once
#include <vector>

#include "render/image/image.h"
#include "render/stage/stage.h"

namespace sprung {

/// A picture with faint things in it is the mean of a few, each of what is at least that opaque. Where faint things lie
/// one behind the other, they are together as faint as one of them, so that a thousand of them still hide nothing.
struct PictureLayer {
  float least_opacity;
  double weight;  // in the mean; that of all layers is 1
};

/// The most opaque one first. Without anything faint it is one layer.
[[nodiscard]] std::vector<PictureLayer> picture_layers(bool has_ghosts, const std::vector<SkinShape>& shapes);

/// Of pictures of the same size, one a layer.
[[nodiscard]] Image mean_of(std::vector<Image> pictures, const std::vector<PictureLayer>& layers);

}  // namespace sprung
