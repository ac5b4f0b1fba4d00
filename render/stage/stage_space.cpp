#include "render/stage/stage_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

constexpr double kKeyAzimuth = -28;     // degrees about y, as a camera's
constexpr double kKeyElevation = 52;    // degrees
constexpr double kSmallestSize = 1e-9;  // m

}  // namespace

StageSpace::StageSpace(const AlignedBox& bounds)
    : center(bounds.center()), scale(1 / std::max(0.5 * bounds.diagonal().norm(), kSmallestSize)) {
  center = center.cast<float>().cast<double>();  // the shaders subtract it in single precision
}

Vec3 to_key_light() {
  const double a = kKeyAzimuth * std::numbers::pi / 180;
  const double e = kKeyElevation * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

}  // namespace sprung
