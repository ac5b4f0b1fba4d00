#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/io/decode_image.h"

namespace sprung {

/// What the upper half of a panorama does to surfaces; from below comes what the floor sends back.
struct Environment {
  /// Irradiance / pi by the surface's direction: factors of the real spherical harmonics up to the second degree, as
  /// polynomials of the direction, in the order 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 (Ramamoorthi and Hanrahan,
  /// "An Efficient Representation for Irradiance Environment Maps", 2001).
  std::array<Eigen::Vector3f, 9> irradiance;
  /// What surfaces of roughness 1/4, 1/2 and 3/4 reflect by the mirrored direction: the panorama smoothed by their
  /// highlights; each half as wide and high as the one before.
  std::array<Panorama, 3> reflections;

  /// The same brightness whatever the panorama's: on level ground it is that of the studio's sky; colours and
  /// directions are the panorama's. Throws Error(kBadInput) where it is not twice as wide as high, or black above the
  /// horizon. Deterministic.
  explicit Environment(const Panorama& panorama);
  /// On a surface that faces there; a unit vector.
  [[nodiscard]] Eigen::Vector3f irradiance_on(const Eigen::Vector3f& direction) const;
};

/// Irradiance / pi of the studio's open sky on level ground.
[[nodiscard]] Eigen::Vector3f studio_sky();

}  // namespace sprung
