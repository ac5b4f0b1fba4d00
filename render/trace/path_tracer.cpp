#include "render/trace/path_tracer.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "render/trace/smooth_light.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kTile = 16;  // pixels

/// Mean and variance of what some samples of a pixel saw.
class LayerSum {
 public:
  void add(const Vector3f& light) {
    const float brightness = light.sum() / 3;
    light_ += light;
    brightness_ += brightness;
    squares_ += brightness * brightness;
    ++count_;
  }
  void store(LightLayer& layer, std::size_t pixel, int samples) const {
    if (count_ == 0) return;
    const auto count = float(count_);
    const float mean = brightness_ / count;
    layer.light[pixel] = light_ / count;
    layer.variance[pixel] = std::max(squares_ / count - mean * mean, 0.0F) / std::max(count - 1, 1.0F);
    layer.share[pixel] = count / float(samples);
  }

 private:
  Vector3f light_ = Vector3f::Zero();
  float brightness_ = 0;
  float squares_ = 0;
  int count_ = 0;
};

}  // namespace

void PathTracer::trace_pixel(const CameraRays& rays, bool moves, int x, int y, TracedLight& traced) const {
  const std::size_t pixel = std::size_t(y) * std::size_t(traced.width) + std::size_t(x);
  LayerSum base;
  LayerSum specular;
  LayerSum floor;
  const auto through = [&](const Eigen::Vector2f& inside, const Eigen::Vector2f& lens) {
    return rays.through({(float(x) + inside.x()) / float(traced.width), (float(y) + inside.y()) / float(traced.height)},
                        lens);
  };
  const int samples =
      rays.has_lens()
          ? options_.samples
          : paths_.worthwhile(options_.samples, through(Eigen::Vector2f::Constant(0.5F), Eigen::Vector2f::Zero()));
  const auto part = 1 / float(samples);
  for (int i = 0; i < samples; ++i) {
    Sampler sampler{std::uint32_t(pixel), std::uint32_t(i)};
    const Eigen::Vector2f inside = sampler.pair();
    const Eigen::Vector2f lens = rays.has_lens() ? sampler.pair() : Eigen::Vector2f::Zero();
    Ray ray = through(inside, lens);
    if (moves) ray.time = sampler.number();
    const bool sees_ghosts = paths_.has_ghosts() && sampler.number() < float(kGhostOpacity);
    const PathSample sample = paths_.sample(ray, sees_ghosts, sampler);
    traced.position[pixel] += part * sample.position;
    if (sample.seen == Seen::kSkin) {
      base.add(sample.light.base);
      specular.add(sample.light.specular);
      traced.color[pixel] += part * sample.color;
      traced.normal[pixel] += part * sample.normal;
    } else if (sample.seen == Seen::kFloor) {
      floor.add(sample.floor_light);
      traced.floor_color[pixel] += part * sample.backdrop;
    } else {
      traced.background[pixel] += part * sample.backdrop;
    }
  }
  base.store(traced.base, pixel, samples);
  specular.store(traced.specular, pixel, samples);
  floor.store(traced.floor, pixel, samples);
}

TracedLight PathTracer::trace(const Motion& motion, const Camera& camera) {
  paths_.update(motion);
  TracedLight traced(options_.width, options_.height);
  const CameraRays rays(camera, paths_.space(), double(options_.width) / options_.height);
  tbb::parallel_for(tbb::blocked_range2d<int>(0, options_.height, kTile, 0, options_.width, kTile),
                    [&](const tbb::blocked_range2d<int>& tile) {
                      for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
                        for (int x = tile.cols().begin(); x < tile.cols().end(); ++x)
                          trace_pixel(rays, motion.size() > 1, x, y, traced);
                      }
                    });
  return traced;
}

std::vector<Eigen::Vector4f> PathTracer::draw(const Motion& motion, const Camera& camera) {
  TracedLight traced = trace(motion, camera);
  smooth(traced);
  return composed(traced, options_.transparent);
}

}  // namespace sprung
