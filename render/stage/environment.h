#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/io/decode_image.h"

namespace sprung {

/// Image-based light of the upper half of a panorama. From below, surfaces get the light that the floor reflects.
struct Environment {
  /// Irradiance / pi by the surface's direction: factors of the real spherical harmonics up to the second degree, as
  /// polynomials of the direction, in the order 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 (Ramamoorthi and Hanrahan,
  /// "An Efficient Representation for Irradiance Environment Maps", 2001).
  std::array<Eigen::Vector3f, 9> irradiance;
  /// What surfaces of roughness 1/4, 1/2 and 3/4 reflect, by mirrored direction: the panorama filtered by their
  /// specular lobes; each level is half as wide and high as the one before.
  std::array<Panorama, 3> reflections;

  /// Scales the panorama so that level ground is as bright as under the studio's sky. Throws Error(kBadInput) where it
  /// is not twice as wide as high, or black above the horizon. Deterministic.
  explicit Environment(const Panorama& panorama);
  /// Of a surface whose unit normal is `direction`.
  [[nodiscard]] Eigen::Vector3f irradiance_on(const Eigen::Vector3f& direction) const;
};

}  // namespace sprung
