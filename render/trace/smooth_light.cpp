#include "render/trace/smooth_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kLevels = 5;
constexpr float kBend = 40;       // how much less two pixels count per 1 - cosine between their normals
constexpr float kOffPlane = 6;    // and per sine of the angle between the surface and the way from one to the other
constexpr float kDeviations = 3;  // of the light's noise that still count as alike
constexpr float kSameLight = 1e-3F;

/// What is alike in neighbours, by pixel.
struct Guides {
  std::vector<Vector3f> normal;
  std::vector<Vector3f> position;
};

class Smoother {
 public:
  Smoother(const TracedLight& traced, const Guides& guides)
      : width_(traced.width), height_(traced.height), guides_(guides) {}

  void smooth(LightLayer& layer) const {
    spread_variance(layer);
    LightLayer next = layer;
    for (int level = 0; level < kLevels; ++level) {
      tbb::parallel_for(0, height_, [&](int y) {
        for (int x = 0; x < width_; ++x) smooth_pixel(layer, x, y, 1 << level, next);
      });
      std::swap(layer, next);
    }
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

  /// Calls visit(pixel, weight) for a pixel's neighbours `step` apart and itself.
  template <class Visit>
  void for_neighbors(int x, int y, int step, const Visit& visit) const {
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const int column = x + step * i;
        const int row = y + step * j;
        if (column < 0 || column >= width_ || row < 0 || row >= height_) continue;
        visit(at(column, row), (i == 0 ? 0.5F : 0.25F) * (j == 0 ? 0.5F : 0.25F));
      }
    }
  }

  /// A variance of few samples is itself uncertain.
  void spread_variance(LightLayer& layer) const {
    std::vector<float> spread(layer.variance.size());
    tbb::parallel_for(0, height_, [&](int y) {
      for (int x = 0; x < width_; ++x) {
        float sum = 0;
        float weights = 0;
        for_neighbors(x, y, 1, [&](std::size_t pixel, float weight) {
          sum += weight * layer.share[pixel] * layer.variance[pixel];
          weights += weight * layer.share[pixel];
        });
        spread[at(x, y)] = weights > 0 ? sum / weights : 0;
      }
    });
    layer.variance = std::move(spread);
  }

  [[nodiscard]] float unlikeness(std::size_t here, std::size_t there) const {
    const Vector3f& normal = guides_.normal[here];
    const Vector3f way = guides_.position[there] - guides_.position[here];
    const float bend = 1 - std::min(normal.dot(guides_.normal[there]), 1.0F);
    return kBend * bend + kOffPlane * std::abs(normal.dot(way)) / (way.norm() + 1e-6F);
  }

  void smooth_pixel(const LightLayer& layer, int x, int y, int step, LightLayer& next) const {
    const std::size_t here = at(x, y);
    if (layer.share[here] == 0) return;
    const float brightness = layer.light[here].sum() / 3;
    const float noise = kDeviations * std::sqrt(layer.variance[here]) + kSameLight;
    Vector3f sum = Vector3f::Zero();
    float variance = 0;
    float weights = 0;
    for_neighbors(x, y, step, [&](std::size_t there, float weight) {
      if (layer.share[there] == 0) return;
      const float other = layer.light[there].sum() / 3;
      if (there != here) weight *= std::exp(-unlikeness(here, there) - std::abs(other - brightness) / noise);
      weight *= layer.share[there];
      sum += weight * layer.light[there];
      variance += weight * weight * layer.variance[there];
      weights += weight;
    });
    next.light[here] = sum / weights;
    next.variance[here] = variance / (weights * weights);
  }

  int width_;
  int height_;
  const Guides& guides_;
};

}  // namespace

void smooth(TracedLight& traced) {
  Guides skins{traced.normal, traced.position};
  for (Vector3f& normal : skins.normal) {
    if (normal.squaredNorm() > 0) normal.normalize();
  }
  const Smoother of_skins(traced, skins);
  of_skins.smooth(traced.base);
  of_skins.smooth(traced.specular);
  const Guides floor{std::vector<Vector3f>(traced.pixels(), Vector3f::UnitY()), traced.position};
  Smoother(traced, floor).smooth(traced.floor);
}

std::vector<Eigen::Vector4f> composed(const TracedLight& traced, bool is_transparent) {
  std::vector<Eigen::Vector4f> picture(traced.pixels());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    Vector3f light =
        traced.color[i].cwiseProduct(traced.base.light[i]) + traced.base.share[i] * traced.specular.light[i];
    if (!is_transparent) light += traced.floor_color[i].cwiseProduct(traced.floor.light[i]) + traced.background[i];
    picture[i] = {light.x(), light.y(), light.z(), is_transparent ? traced.base.share[i] : 1};
  }
  return picture;
}

}  // namespace sprung
