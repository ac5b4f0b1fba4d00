#include "render/trace/body_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/directions.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr int kMaxSteps = 512;
constexpr int kSureSteps = 4;  // before Russian roulette may end a walk

Vector3f on_sphere(const Eigen::Vector2f& random) {
  const float height = 1 - 2 * random.x();
  const float radius = std::sqrt(std::max(0.0F, 1 - height * height));
  const float turn = 2 * std::numbers::pi_v<float> * random.y();
  return {radius * std::cos(turn), radius * std::sin(turn), height};
}

SurfacePoint from_outside(SurfacePoint point) {
  std::swap(point.position, point.behind);
  point.normal = -point.normal;
  point.face_normal = -point.face_normal;
  point.is_inside = false;
  return point;
}

/// Chooses at random between reflection back into the body and leaving it.
bool leaves(Ray& ray, const SurfacePoint& point, Sampler& sampler) {
  const float cosine = std::max(-ray.direction.dot(point.normal), 1e-3F);
  const std::optional<Vector3f> out = refracted(ray.direction, point.normal, 1 / Medium::kIndex);
  if (out && sampler.number() >= fresnel(cosine, 1 / Medium::kIndex)) {
    ray.direction = *out;
    return true;
  }
  ray.direction = (ray.direction + 2 * cosine * point.normal).normalized();
  ray.origin = point.position;
  return false;
}

}  // namespace

std::optional<Emergence> walk_through_body(const TracedSkins& skins, const Media& media, const SurfacePoint& entry,
                                           const Ray& inside, Sampler& sampler) {
  Ray ray = inside;
  Interior interior(media);
  interior.enter(entry);
  Vector3f share = Vector3f::Ones();
  bool is_scattered = false;
  for (int step = 0; step < kMaxSteps; ++step) {
    ray.far = -std::log(1 - sampler.number()) / interior.medium().scattering;
    const std::optional<SurfacePoint> met = skins.first_hit(ray);
    share = share.cwiseProduct(interior.medium().kept(met ? met->distance : ray.far));
    if (step >= kSureSteps) {
      const float stay = std::min(share.maxCoeff(), 1.0F);
      if (!(sampler.number() < stay)) return std::nullopt;
      share /= stay;
    }
    if (!met) {
      ray.origin += ray.far * ray.direction;
      ray.direction = on_sphere(sampler.pair());
      is_scattered = true;
    } else if (!media.is_entered(met->skin)) {
      share = share.cwiseProduct(met->color);
      ray.origin = met->position;
      ray.direction = TangentFrame(met->normal).to_world(on_cosine_hemisphere(sampler.pair()));
      is_scattered = true;
    } else if (!met->is_inside) {
      interior.enter(*met);
      ray.origin = met->behind;
    } else if (!interior.is_only(met->skin)) {
      interior.leave(met->skin);
      ray.origin = met->behind;
    } else if (is_scattered || leaves(ray, *met, sampler)) {
      return Emergence{from_outside(*met), ray.direction, is_scattered, share};
    }
  }
  return std::nullopt;
}

}  // namespace sprung
