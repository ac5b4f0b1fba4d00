#include "render/trace/stage_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/stage/panorama.h"
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
  return lighting.floor.cwiseProduct(ground_light).cwiseProduct(mix({1.02F, 1.01F, 1.0F}, lighting.far_off, up));
}

}  // namespace

StageLight::StageLight(const Stage& stage) : StageLight(lighting_of(stage), stage.environment, stage.floor) {}

StageLight::StageLight(const Lighting& lighting, const std::optional<Environment>& environment, Floor floor)
    : environment_(environment),
      floor_(std::move(floor)),
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

Vector3f StageLight::background(const Vector3f& direction) const {
  if (even_) return *even_;
  if (!environment_ || !environment_->background) return cyclorama(direction.y(), lighting_);
  return environment_->scale * looked_up(*environment_->background, direction);
}

Vector3f StageLight::floor(const Vector3f& direction, const Vector3f& albedo) const {
  const bool is_even = !floor_.has_horizon && !(environment_ && environment_->background);
  if (even_ || is_even) return background(direction);
  const Eigen::Vector2f end = floor_.end();
  const Vector3f near = albedo.cwiseProduct(lighting_.key * to_key_.y() + lighting_.sky);
  return mix(near, background(direction), smoothstep(end.x(), end.y(), direction.y()));
}

Vector3f StageLight::towards_key(const Eigen::Vector2f& random) const {
  const float cosine = 1 - random.x() * (1 - key_cosine_);
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  const float turn = 2 * std::numbers::pi_v<float> * random.y();
  return key_frame_.to_world({sine * std::cos(turn), sine * std::sin(turn), cosine});
}

}  // namespace sprung
