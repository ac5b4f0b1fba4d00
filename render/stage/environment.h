#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "core/io/decode_image.h"
#include "render/stage/sun.h"

namespace sprung {

struct EnvironmentUse {
  double turn = 0;       // degrees about the vertical; azimuths grow by it
  bool has_sun = false;  // the brightest spot may be a sun, which is for the key light: see lit_by()
  bool is_seen = false;  // as the background
};

/// Image-based light of the upper half of a panorama. From below, surfaces get the light that the floor reflects.
struct Environment {
  /// Irradiance / pi by the surface's direction: factors of the real spherical harmonics up to the second degree, as
  /// polynomials of the direction, in the order 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 (Ramamoorthi and Hanrahan,
  /// "An Efficient Representation for Irradiance Environment Maps", 2001).
  std::array<Eigen::Vector3f, 9> irradiance;
  /// The light that surfaces of roughness 1/4, 1/2 and 3/4 reflect, by mirrored direction: the panorama filtered by
  /// their specular lobes; each level is half as wide and high as the one before.
  std::array<Panorama, 3> reflections;

  std::optional<Sun> sun{};                      // not in the light above
  std::shared_ptr<const Panorama> background{};  // the whole panorama, with the sun; unscaled
  float scale = 1;                               // from the panorama's light to that of the stage

  /// Scales the panorama so that level ground is as bright as under the studio's sky, or what faces its sun as bright
  /// as what faces the studio's key light. Throws Error(kBadInput) if it is not twice as wide as high, or black above
  /// the horizon. Deterministic.
  explicit Environment(const Panorama& panorama, const EnvironmentUse& use = {});
  /// The irradiance of a surface whose unit normal is `direction`.
  [[nodiscard]] Eigen::Vector3f irradiance_on(const Eigen::Vector3f& direction) const;
};

}  // namespace sprung
