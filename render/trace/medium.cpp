#include "render/trace/medium.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// The fraction of light that survives each scattering in a thick medium of that colour: fitted to what half-spaces
/// reflect of even light that enters refracted by Medium::kIndex, within 0.01. Chiang's own fit is for light that
/// enters unrefracted; with it bodies here would be darker than their colour by up to 0.04.
float survival(float color) {
  const float c = std::clamp(color, Medium::kDarkest, 1.0F);
  return c == 1 ? 1 : 1 - std::exp(-5.976F * c + 4.503F * c * c - 6.284F * c * c * c);
}

}  // namespace

Medium::Medium(const Eigen::Vector3f& color, float its_scattering)
    : scattering(its_scattering),
      absorption(color.unaryExpr([its_scattering](float c) { return its_scattering * (1 / survival(c) - 1); })) {}

float fresnel(float cosine, float index) {
  const float square = 1 - (1 - cosine * cosine) / (index * index);
  if (square <= 0) return 1;
  const float behind = std::sqrt(square);
  const float parallel = (index * cosine - behind) / (index * cosine + behind);
  const float across = (cosine - index * behind) / (cosine + index * behind);
  return 0.5F * (parallel * parallel + across * across);
}

std::optional<Eigen::Vector3f> refracted(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal, float index) {
  const float cosine = -direction.dot(normal);
  const float square = 1 - (1 - cosine * cosine) / (index * index);
  if (square <= 0) return std::nullopt;
  return (direction / index + (cosine / index - std::sqrt(square)) * normal).normalized();
}

}  // namespace sprung
