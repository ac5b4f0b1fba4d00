#include "render/stage/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/stage/panorama.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr double kReach = 6;    // degrees around the brightest spot to which its light may extend
constexpr double kAround = 9;   // degrees up to which there is the sky around it
constexpr double kLeast = 0.3;  // of the irradiance that the sky gives
constexpr double kLowest = 5;   // degrees of elevation, as of any key light
constexpr double kHighest = 89;
constexpr float kSmallest = 0.0044F;  // of the real sun
constexpr float kLargest = 0.46F;

float cosine_of(double degrees) { return float(std::cos(degrees * std::numbers::pi / 180)); }

/// Calls visit(index, direction, solid angle) for all texels above the horizon.
template <class Visit>
void for_each_above(const Panorama& panorama, const Visit& visit) {
  for (int y = 0; y < panorama.height / 2; ++y) {
    const double angle = solid_angle(panorama, y);
    for (int x = 0; x < panorama.width; ++x) {
      visit(texel(panorama, x, y), direction_of(panorama, x, y), angle);
    }
  }
}

struct Spot {
  std::vector<std::size_t> texels;
  Vector3f around = Vector3f::Zero();  // mean light next to it
};

Spot spot_around(const Panorama& panorama, const Vector3f& middle) {
  Spot spot;
  double angles = 0;
  Eigen::Vector3d light = Eigen::Vector3d::Zero();
  for_each_above(panorama, [&](std::size_t i, const Vector3f& direction, double angle) {
    const float cosine = direction.dot(middle);
    if (cosine > cosine_of(kReach)) {
      spot.texels.push_back(i);
    } else if (cosine > cosine_of(kAround)) {
      light += angle * panorama.light[i].cast<double>();
      angles += angle;
    }
  });
  if (angles > 0) spot.around = (light / angles).cast<float>();
  return spot;
}

Vector3f brightest_direction(const Panorama& panorama) {
  float most = -1;
  Vector3f brightest = Vector3f::UnitY();
  for_each_above(panorama, [&](std::size_t i, const Vector3f& direction, double) {
    const float light = luminance(panorama.light[i]);
    if (light > most) brightest = direction;
    most = std::max(most, light);
  });
  return brightest;
}

}  // namespace

std::optional<Sun> extract_sun(Panorama& panorama) {
  const Spot spot = spot_around(panorama, brightest_direction(panorama));
  Panorama without = panorama;
  for (const std::size_t i : spot.texels) without.light[i] = without.light[i].cwiseMin(spot.around);
  double sky = 0;  // irradiance of level ground
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for_each_above(panorama, [&](std::size_t i, const Vector3f& direction, double angle) {
    sky += angle * double(luminance(without.light[i]) * direction.y());
    const Vector3f excess = panorama.light[i] - without.light[i];
    sum += angle * excess.cast<double>();
    middle += angle * double(luminance(excess)) * direction.cast<double>();
  });
  const double excess = luminance(sum.cast<float>());
  if (!(excess > 0) || excess * middle.normalized().y() < kLeast * sky) return std::nullopt;
  Sun sun{middle.normalized().cast<float>(), (sum / std::numbers::pi).cast<float>(), 0};
  double squares = 0;  // of the sine of the angle from the middle, whose mean over a disc is half of the radius squared
  for_each_above(panorama, [&](std::size_t i, const Vector3f& direction, double angle) {
    const float light = luminance(panorama.light[i] - without.light[i]);
    if (light > 0) squares += angle * double(light * direction.cross(sun.direction).squaredNorm());
  });
  sun.radius = std::clamp(float(std::sqrt(2 * squares / excess)), kSmallest, kLargest);
  panorama = std::move(without);
  return sun;
}

Lighting lit_by(const Sun& sun, Lighting lighting) {
  constexpr double kDegree = std::numbers::pi / 180;
  lighting.azimuth = std::atan2(sun.direction.x(), sun.direction.z()) / kDegree;
  lighting.elevation = std::clamp(std::asin(double{sun.direction.y()}) / kDegree, kLowest, kHighest);
  lighting.key = sun.irradiance;
  lighting.key_radius = sun.radius;
  return lighting;
}

}  // namespace sprung
