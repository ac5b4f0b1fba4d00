#include "render/trace/path_tracer.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "render/trace/smooth_light.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kBlock = 4;         // pixels: squares of this side are refined together
constexpr int kTile = 4;          // blocks
constexpr int kFirstShare = 6;    // this many times fewer samples show whether more are needed
constexpr float kLittle = 0.12F;  // noise of a pixel of the floor, over its light without bodies

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
  [[nodiscard]] int count() const { return count_; }
  /// The variance of the mean.
  [[nodiscard]] float variance() const {
    const auto count = float(std::max(count_, 1));
    const float mean = brightness_ / count;
    return std::max(squares_ / count - mean * mean, 0.0F) / std::max(count - 1, 1.0F);
  }
  void store(LightLayer& layer, std::size_t pixel, int samples) const {
    if (count_ == 0) return;
    layer.light[pixel] = light_ / float(count_);
    layer.variance[pixel] = variance();
    layer.share[pixel] = float(count_) / float(samples);
  }

 private:
  Vector3f light_ = Vector3f::Zero();
  float brightness_ = 0;
  float squares_ = 0;
  int count_ = 0;
};

/// Sums over the samples of a pixel.
class PixelSum {
 public:
  void add(const PathSample& sample) {
    ++samples_;
    if (sample.seen == Seen::kSkin) {
      position_ += sample.position;
      base_.add(sample.light.base);
      specular_.add(sample.light.specular);
      color_ += sample.color;
      normal_ += sample.normal;
    } else if (sample.seen == Seen::kFloor) {
      floor_.add(sample.floor_light);
      floor_color_ += sample.backdrop;
    } else {
      background_ += sample.backdrop;
    }
  }
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] bool sees_skin() const { return base_.count() > 0; }
  [[nodiscard]] float floor_variance() const { return floor_.variance(); }
  void store(TracedLight& traced, std::size_t pixel) const {
    const float part = 1 / float(samples_);
    base_.store(traced.base, pixel, samples_);
    specular_.store(traced.specular, pixel, samples_);
    floor_.store(traced.floor, pixel, samples_);
    traced.color[pixel] = part * color_;
    traced.normal[pixel] = part * normal_;
    traced.position[pixel] = position_ / float(std::max(base_.count(), 1));
    traced.floor_color[pixel] = part * floor_color_;
    traced.background[pixel] = part * background_;
  }

 private:
  int samples_ = 0;
  LayerSum base_;
  LayerSum specular_;
  LayerSum floor_;
  Vector3f color_ = Vector3f::Zero();
  Vector3f normal_ = Vector3f::Zero();
  Vector3f position_ = Vector3f::Zero();
  Vector3f floor_color_ = Vector3f::Zero();
  Vector3f background_ = Vector3f::Zero();
};

using BlockSums = std::array<PixelSum, std::size_t(kBlock) * kBlock>;

/// Whether a block shows a skin, or floor whose light is uncertain: in the edge of a shadow, say.
bool needs_more(const BlockSums& block) {
  float variance = 0;
  for (const PixelSum& sum : block) {
    if (sum.sees_skin()) return true;
    variance += sum.floor_variance();
  }
  return variance > kLittle * kLittle * float(block.size());
}

/// Samples the pixels of one picture.
class PixelSampler {
 public:
  PixelSampler(const LightPaths& paths, const CameraRays& rays, bool moves, int samples, TracedLight& traced)
      : paths_(paths), rays_(rays), moves_(moves), samples_(samples), traced_(traced) {}

  void sample_block(int left, int top) const {
    BlockSums block;
    const int first = paths_.has_pattern() ? samples_ : (samples_ + kFirstShare - 1) / kFirstShare;
    const auto for_pixels = [&](const auto& visit) {
      for (int y = top; y < std::min(top + kBlock, traced_.height); ++y) {
        for (int x = left; x < std::min(left + kBlock, traced_.width); ++x) {
          visit(x, y, block[std::size_t((y - top) * kBlock + x - left)]);
        }
      }
    };
    for_pixels([&](int x, int y, PixelSum& sum) {
      sample_pixel(x, y, is_empty(x, y) && !paths_.has_pattern() ? 1 : first, sum);
    });
    if (needs_more(block) || is_beside_skin(left, top)) {
      for_pixels([&](int x, int y, PixelSum& sum) {
        if (sum.samples() == first) sample_pixel(x, y, samples_, sum);
      });
    }
    for_pixels([&](int x, int y, const PixelSum& sum) { sum.store(traced_, pixel(x, y)); });
  }

 private:
  [[nodiscard]] std::size_t pixel(int x, int y) const { return std::size_t(y) * std::size_t(traced_.width) + x; }

  [[nodiscard]] Ray through(int x, int y, const Eigen::Vector2f& inside, const Eigen::Vector2f& lens) const {
    return rays_.through(
        {(float(x) + inside.x()) / float(traced_.width), (float(y) + inside.y()) / float(traced_.height)}, lens);
  }

  [[nodiscard]] Ray through_middle(int x, int y) const {
    return through(x, y, Eigen::Vector2f::Constant(0.5F), Eigen::Vector2f::Zero());
  }

  [[nodiscard]] bool is_empty(int x, int y) const {
    return !rays_.has_lens() && paths_.sees_nothing(through_middle(x, y));
  }

  /// Whether a pixel around the block shows a skin: its edge may run through the block where few samples miss it.
  [[nodiscard]] bool is_beside_skin(int left, int top) const {
    for (int i = -1; i <= kBlock; ++i) {
      for (const int j : {-1, kBlock}) {
        if (paths_.sees_skin(through_middle(left + i, top + j))) return true;
        if (paths_.sees_skin(through_middle(left + j, top + i))) return true;
      }
    }
    return false;
  }

  /// Samples it up to that many times in all.
  void sample_pixel(int x, int y, int samples, PixelSum& sum) const {
    while (sum.samples() < samples) {
      Sampler sampler(x, y, sum.samples(), samples_);
      const Eigen::Vector2f inside = sampler.pair();
      const Eigen::Vector2f lens = rays_.has_lens() ? sampler.pair() : Eigen::Vector2f::Zero();
      Ray ray = through(x, y, inside, lens);
      if (moves_) ray.time = sampler.number();
      const float opacity = paths_.has_faint() ? sampler.number() : 1;
      sum.add(paths_.sample(ray, opacity, sampler));
    }
  }

  const LightPaths& paths_;
  const CameraRays& rays_;
  bool moves_;
  int samples_;
  TracedLight& traced_;
};

}  // namespace

TracedLight PathTracer::trace(const Motion& motion, const Camera& camera) {
  paths_.update(motion);
  TracedLight traced(options_.width, options_.height);
  const CameraRays rays(camera, paths_.space(), double(options_.width) / options_.height);
  const PixelSampler sampler(paths_, rays, motion.size() > 1, options_.samples, traced);
  const auto blocks = [](int pixels) { return (pixels + kBlock - 1) / kBlock; };
  tbb::parallel_for(tbb::blocked_range2d<int>(0, blocks(options_.height), kTile, 0, blocks(options_.width), kTile),
                    [&](const tbb::blocked_range2d<int>& tile) {
                      for (int row = tile.rows().begin(); row < tile.rows().end(); ++row) {
                        for (int column = tile.cols().begin(); column < tile.cols().end(); ++column)
                          sampler.sample_block(column * kBlock, row * kBlock);
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
