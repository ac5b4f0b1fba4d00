#pragma once
#include <vector>

#include "render/image/image.h"
#include "render/stage/stage.h"

namespace sprung {

/// A picture with translucent objects is the mean of a few, each of the objects that are at least that opaque.
/// Overlapping translucent objects are together as faint as one of them, so that a thousand of them still hide nothing.
struct PictureLayer {
  float min_opacity;
  double weight;  // in the mean; the weights add up to 1
};

/// The most opaque one first; a single layer if nothing is translucent.
[[nodiscard]] std::vector<PictureLayer> picture_layers(bool has_ghosts, const std::vector<SkinShape>& shapes);

/// The mean of pictures of the same size, one per layer.
[[nodiscard]] Image mean_of(std::vector<Image> pictures, const std::vector<PictureLayer>& layers);

}  // namespace sprung
