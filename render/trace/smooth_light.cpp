#include "render/trace/smooth_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr std::array kSteps = {1, 2, 4, 8, 16, 1};  // pixels; the last one removes the pattern of those before
constexpr float kBend = 20;            // how much less two pixels count per 1 - cosine between their normals
constexpr float kOffPlane = 6;         // and per sine of the angle between the surface and the line between them
constexpr float kPaint = 8;            // and per difference of colours
constexpr float kSkinDeviations = 4;   // of the light's noise that still count as similar
constexpr float kFloorDeviations = 3;  // less, since nothing else shows where a body stands on it
constexpr float kSameLight = 1e-3F;

/// Features compared between neighbours, by pixel; none on the floor, which is flat.
struct Guides {
  std::vector<Vector3f> normal;  // unit
  std::vector<Vector3f> position;
  std::vector<Vector3f> color;
};

/// exp(-x) for x >= 0 within 0.04, and 0 from 8 on.
float falloff(float x) {
  const float root = std::max(1 - x / 8, 0.0F);
  const float square = root * root;
  return square * square * square * square;
}

template <std::size_t kCount>
class Smoother {
 public:
  using Layers = std::array<LightLayer*, kCount>;

  Smoother(const TracedLight& traced, const Layers& layers, float deviations, Guides guides)
      : width_(traced.width),
        height_(traced.height),
        layers_(layers),
        deviations_(deviations),
        guides_(std::move(guides)) {}

  void smooth() const {
    for (LightLayer* const layer : layers_) spread_variance(*layer);
    std::vector<LightLayer> next;
    for (const LightLayer* const layer : layers_) next.push_back(*layer);
    for (const int step : kSteps) {
      tbb::parallel_for(0, height_, [&](int y) {
        for (int x = 0; x < width_; ++x) smooth_pixel(x, y, step, next);
      });
      for (std::size_t i = 0; i < kCount; ++i) std::swap(*layers_[i], next[i]);
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
    for (const int step : {1, 2}) {
      tbb::parallel_for(0, height_, [&](int y) {
        for (int x = 0; x < width_; ++x) {
          float sum = 0;
          float weights = 0;
          for_neighbors(x, y, step, [&](std::size_t pixel, float weight) {
            sum += weight * layer.share[pixel] * layer.variance[pixel];
            weights += weight * layer.share[pixel];
          });
          spread[at(x, y)] = weights > 0 ? sum / weights : 0;
        }
      });
      std::swap(layer.variance, spread);
    }
  }

  [[nodiscard]] float unlikeness(std::size_t here, std::size_t there) const {
    if (guides_.normal.empty()) return 0;
    const Vector3f& normal = guides_.normal[here];
    const Vector3f way = guides_.position[there] - guides_.position[here];
    const float bend = 1 - std::min(normal.dot(guides_.normal[there]), 1.0F);
    const float paint = (guides_.color[there] - guides_.color[here]).norm();
    return kPaint * paint + kBend * bend + kOffPlane * std::abs(normal.dot(way)) / (way.norm() + 1e-6F);
  }

  void smooth_pixel(int x, int y, int step, std::vector<LightLayer>& next) const {
    struct Mean {
      float noise;
      float brightness;
      Vector3f light = Vector3f::Zero();
      float variance = 0;
      float weight = 0;
    };
    const std::size_t here = at(x, y);
    std::array<Mean, kCount> means;
    bool is_certain = true;
    for (std::size_t i = 0; i < kCount; ++i) {
      const LightLayer& layer = *layers_[i];
      means[i].brightness = layer.light[here].sum() / 3;
      means[i].noise = deviations_ * std::sqrt(layer.variance[here]) + kSameLight;
      is_certain = is_certain && layer.variance[here] == 0;
      next[i].light[here] = layer.light[here];
      next[i].variance[here] = layer.variance[here];
    }
    const std::vector<float>& share = layers_.front()->share;  // of all alike
    if (is_certain || share[here] == 0) return;
    for_neighbors(x, y, step, [&](std::size_t there, float weight) {
      if (share[there] == 0) return;
      const float apart = there == here ? 0 : unlikeness(here, there);
      weight *= share[there];
      for (std::size_t i = 0; i < kCount; ++i) {
        const Vector3f& light = layers_[i]->light[there];
        const float change = std::abs(light.sum() / 3 - means[i].brightness) / means[i].noise;
        const float alike = weight * falloff(apart + change);
        means[i].light += alike * light;
        means[i].variance += alike * alike * layers_[i]->variance[there];
        means[i].weight += alike;
      }
    });
    for (std::size_t i = 0; i < kCount; ++i) {
      next[i].light[here] = means[i].light / means[i].weight;
      next[i].variance[here] = means[i].variance / (means[i].weight * means[i].weight);
    }
  }

  int width_;
  int height_;
  Layers layers_;
  float deviations_;
  Guides guides_;
};

}  // namespace

void smooth(TracedLight& traced) {
  Guides skins{std::move(traced.normal), std::move(traced.position), traced.color};
  for (std::size_t i = 0; i < traced.pixels(); ++i) {
    if (traced.base.share[i] == 0) continue;
    skins.normal[i].normalize();
    skins.color[i] /= traced.base.share[i];
  }
  Smoother<2>(traced, {&traced.base, &traced.specular}, kSkinDeviations, std::move(skins)).smooth();
  Smoother<1>(traced, {&traced.floor}, kFloorDeviations, {}).smooth();
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
