#include "render/trace/stage_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/directions.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

const Vector3f kWindow(-0.880F, 0.300F, 0.368F);

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

Vector3f mix(const Vector3f& a, const Vector3f& b, float share) { return a + share * (b - a); }

/// cyclorama() of light.glsl.
Vector3f cyclorama(float rise, const Lighting& lighting) {
  const Vector3f ground_light = lighting.key * float(lighting.to_key().y()) + lighting.sky;
  const float up = smoothstep(-0.55F, 0.40F, rise);
  return StageLight::floor_albedo()
      .cwiseProduct(ground_light)
      .cwiseProduct(mix({1.02F, 1.01F, 1.0F}, lighting.far_off, up));
}

/// Bilinear, wrapping around the vertical.
Vector3f looked_up(const Panorama& panorama, const Vector3f& direction) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float x = (0.5F + std::atan2(direction.x(), -direction.z()) / (2 * kPi)) * float(panorama.width) - 0.5F;
  const float y = std::acos(std::clamp(direction.y(), -1.0F, 1.0F)) / kPi * float(panorama.height) - 0.5F;
  const int left = int(std::floor(x));
  const int top = int(std::floor(y));
  const auto texel = [&](int column, int row) {
    const int wrapped = (column % panorama.width + panorama.width) % panorama.width;
    return panorama.light[std::size_t(std::clamp(row, 0, panorama.height - 1)) * panorama.width + wrapped];
  };
  const float across = x - float(left);
  return mix(mix(texel(left, top), texel(left + 1, top), across),
             mix(texel(left, top + 1), texel(left + 1, top + 1), across), y - float(top));
}

}  // namespace

Vector3f StageLight::floor_albedo() { return {0.74F, 0.722F, 0.700F}; }

StageLight::StageLight(const Stage& stage) : StageLight(lighting_of(stage), stage.environment) {}

StageLight::StageLight(const Lighting& lighting, const std::optional<Environment>& environment)
    : environment_(environment),
      lighting_(lighting),
      to_key_(lighting.to_key().cast<float>()),
      key_frame_(to_key_),
      key_cosine_(1 / std::sqrt(1 + lighting.key_radius * lighting.key_radius)),
      key_density_(1 / (2 * std::numbers::pi_v<float> * (1 - key_cosine_))),
      key_radiance_(lighting.key / (1 - key_cosine_ * key_cosine_)),
      on_open_floor_(lighting.key * to_key_.y()) {
  constexpr int kFine = 128;
  on_open_floor_ += from_around(Vector3f::UnitY(), kFine);
}

StageLight StageLight::even(const Vector3f& radiance) {
  StageLight light(lighting_of(LightPreset::kStudio), std::nullopt);
  light.even_ = radiance;
  light.key_radiance_.setZero();
  light.on_open_floor_ = radiance;
  return light;
}

Vector3f StageLight::from_around(const Vector3f& normal, int side) const {
  const TangentFrame frame(normal);
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < side * side; ++i) sum += around(frame.to_world(on_cosine_hemisphere(on_grid(i, side))));
  return sum / (side * side);
}

Vector3f StageLight::around(const Vector3f& direction) const {
  if (even_) return *even_;
  if (direction.y() < 0) return floor_albedo().cwiseProduct(lighting_.key * to_key_.y() + lighting_.sky);
  return environment_ ? looked_up(environment_->reflections.front(), direction) : studio(direction);
}

/// room() of skin_light.glsl as a mirror sees it.
Vector3f StageLight::studio(const Vector3f& direction) const {
  constexpr float kSoft = 0.04F;
  const float ceiling = smoothstep(0, 0.45F + 0.5F * kSoft, direction.y());
  const float panel = smoothstep(0.66F - kSoft, 0.66F + kSoft, direction.y());
  const float window = smoothstep(0.86F - 0.5F * kSoft, 0.86F + 0.5F * kSoft, direction.dot(kWindow));
  const Vector3f walls = cyclorama(direction.y(), lighting_);
  return mix(walls, 0.5F * lighting_.sky, ceiling) + (0.60F * panel + 1.20F * window) * lighting_.sky;
}

Vector3f StageLight::backdrop(const Vector3f& direction) const {
  if (even_) return *even_;
  return cyclorama(direction.y(), lighting_);
}

Vector3f StageLight::towards_key(const Eigen::Vector2f& random) const {
  const float cosine = 1 - random.x() * (1 - key_cosine_);
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  const float turn = 2 * std::numbers::pi_v<float> * random.y();
  return key_frame_.to_world({sine * std::cos(turn), sine * std::sin(turn), cosine});
}

}  // namespace sprung
