#include "render/picture_layers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sprung {
namespace {

/// The weighted mean of a channel of all pictures, into that of the first.
template <class Channel>
void mix(std::vector<Image>& pictures, const std::vector<PictureLayer>& layers, Channel Image::*channel) {
  Channel& mixed = pictures.front().*channel;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < layers.size(); ++k) sum += layers[k].weight * (pictures[k].*channel)[i];
    mixed[i] = static_cast<std::uint8_t>(std::lround(sum));
  }
}

}  // namespace

std::vector<PictureLayer> picture_layers(bool has_ghosts, const std::vector<SkinShape>& shapes) {
  const bool has_faint = std::any_of(shapes.begin(), shapes.end(), [](const SkinShape& s) { return s.is_faint(); });
  std::vector<PictureLayer> layers;
  for (std::size_t i = kOpacities.size(); i-- > 0;) {
    const bool is_needed = has_faint || kOpacities[i] == 1 || (has_ghosts && kOpacities[i] == kGhostOpacity);
    if (is_needed) layers.push_back({float(kOpacities[i]), kOpacities[i]});
  }
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) layers[i].weight -= layers[i + 1].weight;
  return layers;
}

Image mean_of(std::vector<Image> pictures, const std::vector<PictureLayer>& layers) {
  if (pictures.size() > 1) {
    mix(pictures, layers, &Image::pixels);
    mix(pictures, layers, &Image::alpha);
  }
  return std::move(pictures.front());
}

}  // namespace sprung
