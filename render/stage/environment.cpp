#include "render/stage/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "render/stage/lighting.h"
#include "render/stage/panorama.h"

namespace sprung {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kHeight = 64;  // of the finest level; 2.8 degrees per texel, less than the sharpest highlight
constexpr int kWidestBackground = 4096;
constexpr float kMaxSeen = 60000;  // light of a background: textures hold it as half floats
constexpr int kSharpest = 4;       // one over the roughness of the first level

/// Downsampled to that height, weighted by solid angle; black below the horizon.
Panorama upper_half(const Panorama& panorama, int height) {
  Panorama small{2 * height, height, {}};
  small.light.resize(2 * std::size_t(height) * std::size_t(height), Eigen::Vector3f::Zero());
  std::vector<double> weights(small.light.size());
  std::vector<Eigen::Vector3d> sums(small.light.size(), Eigen::Vector3d::Zero());
  const auto scaled = [](int i, int from, int to) { return int((i + 0.5) * to / from); };
  // Each texel counts where its centre lies; texels of a panorama smaller than the result count several times.
  const int repeat = std::max(1, (height + panorama.height - 1) / panorama.height);
  for (int y = 0; y < repeat * panorama.height / 2; ++y) {
    const double weight = solid_angle({repeat * panorama.width, repeat * panorama.height, {}}, y);
    for (int x = 0; x < repeat * panorama.width; ++x) {
      const std::size_t to = texel(small, scaled(x, repeat * panorama.width, small.width),
                                   scaled(y, repeat * panorama.height, small.height));
      sums[to] += weight * panorama.light[texel(panorama, x / repeat, y / repeat)].cast<double>();
      weights[to] += weight;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (weights[i] > 0) small.light[i] = (sums[i] / weights[i]).cast<float>();
  }
  return small;
}

std::array<float, 9> harmonics(const Eigen::Vector3f& d) {
  return {1,
          d.y(),
          d.z(),
          d.x(),
          d.x() * d.y(),
          d.y() * d.z(),
          3 * d.z() * d.z() - 1,
          d.x() * d.z(),
          d.x() * d.x() - d.y() * d.y()};
}

/// Squared norms of the harmonics times the factor of a cosine lobe for each degree, over pi.
constexpr std::array<double, 9> kFactors{1 / (4 * kPi),         3 / (4 * kPi) * 2 / 3, 3 / (4 * kPi) * 2 / 3,
                                         3 / (4 * kPi) * 2 / 3, 15 / (4 * kPi) / 4,    15 / (4 * kPi) / 4,
                                         5 / (16 * kPi) / 4,    15 / (4 * kPi) / 4,    15 / (16 * kPi) / 4};

std::array<Eigen::Vector3f, 9> irradiance_of(const Panorama& panorama) {
  std::array<Eigen::Vector3d, 9> sums;
  sums.fill(Eigen::Vector3d::Zero());
  for (int y = 0; y < panorama.height; ++y) {
    for (int x = 0; x < panorama.width; ++x) {
      const std::array<float, 9> values = harmonics(direction_of(panorama, x, y));
      const Eigen::Vector3d light = solid_angle(panorama, y) * panorama.light[texel(panorama, x, y)].cast<double>();
      for (std::size_t k = 0; k < values.size(); ++k) sums[k] += double{values[k]} * light;
    }
  }
  std::array<Eigen::Vector3f, 9> irradiance;
  for (std::size_t k = 0; k < sums.size(); ++k) irradiance[k] = (kFactors[k] * sums[k]).cast<float>();
  return irradiance;
}

/// Weight of a highlight seen along its axis: the GGX distribution times the cosine to the light.
float highlight(float cosine, float roughness) {
  const float alpha = roughness * roughness;
  const float bend = 0.5F * (1 + cosine) * (alpha * alpha - 1) + 1;
  return std::max(cosine, 0.0F) * alpha * alpha / (bend * bend);
}

Panorama reflection(const Panorama& source, int height, float roughness) {
  Panorama smooth{2 * height, height, {}};
  std::vector<Eigen::Vector3f> directions;
  std::vector<Eigen::Vector3f> lights;
  std::vector<float> angles;
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      const Eigen::Vector3f direction = direction_of(source, x, y);
      if (direction.y() <= 0) continue;  // below the horizon there is the floor
      directions.push_back(direction);
      lights.push_back(source.light[texel(source, x, y)]);
      angles.push_back(float(solid_angle(source, y)));
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      const Eigen::Vector3f middle = direction_of(smooth, x, y);
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      float weights = 0;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const float cosine = middle.dot(directions[i]);
        if (cosine <= 0) continue;
        const float weight = angles[i] * highlight(cosine, roughness);
        sum += weight * lights[i];
        weights += weight;
      }
      smooth.light.emplace_back(sum / std::max(weights, 1e-12F));
    }
  }
  return smooth;
}

/// The scale at which a surface that faces the sun is as bright as one that faces the studio's key light, or else level
/// ground as bright as under the studio's sky.
float scale_of(const Environment& environment) {
  const Lighting studio = lighting_of(LightPreset::kStudio);
  if (!environment.sun) {
    return luminance(studio.sky) / luminance(environment.irradiance_on(Eigen::Vector3f::UnitY()));
  }
  const auto facing = float(0.5 + 0.5 * studio.to_key().y());  // the share of the sky that the surface sees
  const Sun& sun = *environment.sun;
  return luminance(studio.key + facing * studio.sky) /
         luminance(sun.irradiance + environment.irradiance_on(sun.direction));
}

}  // namespace

Environment::Environment(const Panorama& panorama, const EnvironmentUse& use) {
  if (panorama.width != 2 * panorama.height || panorama.height < 1) {
    throw Error(ErrorKind::kBadInput,
                "the surroundings must be twice as wide as high: all around, from zenith to nadir");
  }
  Panorama around = turned(panorama, use.turn);
  if (use.is_seen) {
    Panorama seen = no_wider_than(around, kWidestBackground);
    for (Eigen::Vector3f& light : seen.light) light = light.cwiseMin(kMaxSeen);
    background = std::make_shared<const Panorama>(std::move(seen));
  }
  if (use.has_sun) sun = extract_sun(around);
  Panorama sky = upper_half(around, kHeight);
  irradiance = irradiance_of(sky);
  if (!sun && !(luminance(irradiance_on(Eigen::Vector3f::UnitY())) > 0)) {
    throw Error(ErrorKind::kBadInput, "the surroundings are black above the horizon: no light");
  }
  scale = scale_of(*this);
  if (sun) sun->irradiance *= scale;
  for (Eigen::Vector3f& part : irradiance) part *= scale;
  for (Eigen::Vector3f& light : sky.light) light *= scale;
  for (std::size_t i = 0; i < reflections.size(); ++i) {
    const int height = kHeight >> i;
    reflections[i] = reflection(upper_half(sky, height), height, float(i + 1) / kSharpest);
  }
}

Eigen::Vector3f Environment::irradiance_on(const Eigen::Vector3f& direction) const {
  const std::array<float, 9> values = harmonics(direction);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < values.size(); ++k) sum += values[k] * irradiance[k];
  return sum.cwiseMax(0.0F);
}

}  // namespace sprung
