#include "render/trace/finish.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/directions.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kReflectance = 0.04F;  // of a dielectric at right angles: an index of refraction of 1.5
constexpr float kLeast = 1e-3F;        // cosine

float power5(float x) { return x * x * x * x * x; }

}  // namespace

Finish::Properties Finish::properties(Look look) {
  switch (look) {
    case Look::kPlastic:
      return {.roughness = 0.42F};
    case Look::kGelatin:
      return {.roughness = 0.22F};
    case Look::kRubber:
      return {.roughness = 0.58F};
    case Look::kSteel:
      return {.roughness = 0.22F, .is_metal = true};
    case Look::kChart:
      return {.roughness = 0.75F, .glow = 0.45F};
  }
  return {.roughness = 1};
}

Finish::Finish(const Properties& properties)
    : alpha_(properties.roughness * properties.roughness),
      is_metal_(properties.is_metal),
      has_base_(!properties.is_metal),
      specular_choice_(properties.roughness >= 1 ? 0
                       : is_metal_               ? 1.0F
                                                 : 0.3F),
      glow_(properties.glow) {
  if (is_matt()) return;
  constexpr int kSide = 32;
  for (int angle = 0; angle <= kAngles; ++angle) {
    const float cosine = std::max(float(angle) / kAngles, kLeast);
    const Vector3f to_eye(std::sqrt(1 - cosine * cosine), 0, cosine);
    Share& share = shares_[std::size_t(angle)];
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vector3f half = half_vector(to_eye, on_grid(i, kSide));
      const Vector3f to_light = 2 * to_eye.dot(half) * half - to_eye;
      if (to_light.z() <= 0) continue;
      const float a2 = alpha_ * alpha_;
      const auto smith = [&](float c) { return std::sqrt(a2 + (1 - a2) * c * c); };
      // Height-correlated shadowing over that of the eye alone.
      const float kept =
          to_light.z() * (cosine + smith(cosine)) / (to_light.z() * smith(cosine) + cosine * smith(to_light.z()));
      const float grazing = power5(1 - std::max(to_eye.dot(half), 0.0F));
      share.scale += kept * (1 - grazing) / (kSide * kSide);
      share.bias += kept * grazing / (kSide * kSide);
    }
  }
  mean_left_to_base_ = 0;
  for (int angle = 0; angle < kAngles; ++angle) {
    const float cosine = (float(angle) + 0.5F) / kAngles;
    mean_left_to_base_ += 2 * cosine * left_to_base(cosine) / kAngles;
  }
}

Finish Finish::no_sharper_than(float roughness) const {
  return Finish({.roughness = std::max(std::sqrt(alpha_), roughness), .is_metal = is_metal_, .glow = glow_});
}

Finish Finish::without_base() const {
  Finish coat = *this;
  coat.has_base_ = false;
  return coat;
}

Finish::Share Finish::share(float cosine) const {
  const float place = std::clamp(cosine, 0.0F, 1.0F) * kAngles;
  const int low = std::min(int(place), kAngles - 1);
  const float up = place - float(low);
  const Share& a = shares_[std::size_t(low)];
  const Share& b = shares_[std::size_t(low) + 1];
  return {a.scale + up * (b.scale - a.scale), a.bias + up * (b.bias - a.bias)};
}

float Finish::left_to_base(float cosine) const {
  const Share of_layer = share(cosine);
  return is_metal_ ? 0 : 1 - kReflectance * of_layer.scale - of_layer.bias;
}

float Finish::distribution(float cosine) const {
  const float bend = cosine * cosine * (alpha_ * alpha_ - 1) + 1;
  return alpha_ * alpha_ / (kPi * bend * bend);
}

Response Finish::respond(const Vector3f& to_eye, const Vector3f& to_light, const Vector3f& color) const {
  Response response;
  const float nl = to_light.z();
  if (nl <= 0 || to_eye.z() <= 0) return response;
  const float nv = std::max(to_eye.z(), kLeast);
  if (has_base_) {
    const float left = is_matt() ? 1 : left_to_base(nv) * left_to_base(nl) / mean_left_to_base_;
    response.reflected.base = Vector3f::Constant(left * nl / kPi);
    response.density = (1 - specular_choice_) * nl / kPi;
  }
  if (is_matt()) return response;
  const Vector3f half = (to_eye + to_light).normalized();
  const float a2 = alpha_ * alpha_;
  const float eye_smith = std::sqrt(a2 + (1 - a2) * nv * nv);
  const float light_smith = std::sqrt(a2 + (1 - a2) * nl * nl);
  const float facets = distribution(half.z());
  const Vector3f reflectance = is_metal_ ? color : Vector3f::Constant(kReflectance).eval();
  const Vector3f fresnel =
      reflectance + (Vector3f::Ones() - reflectance) * power5(1 - std::max(to_eye.dot(half), 0.0F));
  response.reflected.specular = 0.5F * facets * nl / (nl * eye_smith + nv * light_smith) * fresnel;
  // The distribution of visible normals over four times the cosine to them.
  response.density += specular_choice_ * facets / (2 * (nv + eye_smith));
  if (!is_metal_) return response;
  const Share once = share(nv);
  response.reflected.specular += (1 / (once.scale + once.bias) - 1) * color.cwiseProduct(response.reflected.specular);
  return response;
}

/// A normal of the facets that the eye sees: E. Heitz, "Sampling the GGX Distribution of Visible Normals" (2018).
Vector3f Finish::half_vector(const Vector3f& to_eye, const Eigen::Vector2f& random) const {
  const Vector3f stretched = Vector3f(alpha_ * to_eye.x(), alpha_ * to_eye.y(), to_eye.z()).normalized();
  Eigen::Vector2f at = on_disc(random);
  // The half of the disc behind the horizon is squeezed into what is visible, along the direction that rises.
  const Vector3f level = Vector3f(-stretched.y(), stretched.x(), 0);
  const Vector3f across = level.squaredNorm() > 1e-8F ? level.normalized().eval() : Vector3f::UnitX().eval();
  const Vector3f rising = stretched.cross(across);
  const float share = 0.5F * (1 + stretched.z());
  at.y() = (1 - share) * std::sqrt(std::max(0.0F, 1 - at.x() * at.x())) + share * at.y();
  const Vector3f on_hemisphere =
      at.x() * across + at.y() * rising + std::sqrt(std::max(0.0F, 1 - at.squaredNorm())) * stretched;
  return Vector3f(alpha_ * on_hemisphere.x(), alpha_ * on_hemisphere.y(), std::max(on_hemisphere.z(), 1e-6F))
      .normalized();
}

Vector3f Finish::sample(const Vector3f& to_eye, const Eigen::Vector2f& random, float choice) const {
  if (choice >= specular_choice_) return on_cosine_hemisphere(random);
  const Vector3f half = half_vector(to_eye, random);
  return 2 * to_eye.dot(half) * half - to_eye;
}

}  // namespace sprung
