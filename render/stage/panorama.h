#pragma once
#include "core/io/decode_image.h"

namespace sprung {

/// Unit vector through the middle of a texel.
[[nodiscard]] Eigen::Vector3f direction_of(const Panorama& panorama, int x, int y);

/// The solid angle of a texel in that row.
[[nodiscard]] double solid_angle(const Panorama& panorama, int y);

[[nodiscard]] inline std::size_t texel(const Panorama& panorama, int x, int y) {
  return std::size_t(y) * std::size_t(panorama.width) + std::size_t(x);
}

/// Light from a direction (unit), bilinear.
[[nodiscard]] Eigen::Vector3f looked_up(const Panorama& panorama, const Eigen::Vector3f& direction);

/// Rotated about the vertical: what was at an azimuth is `degrees` further.
[[nodiscard]] Panorama turned(const Panorama& panorama, double degrees);

/// Downsampled by averaging whole squares of texels, so that it is at most `width` wide.
[[nodiscard]] Panorama no_wider_than(const Panorama& panorama, int width);

/// Luminance by the weights of Rec. 709.
[[nodiscard]] inline float luminance(const Eigen::Vector3f& light) {
  return Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F).dot(light);
}

}  // namespace sprung
