#pragma once
#include <optional>

#include "core/io/decode_image.h"
#include "render/stage/lighting.h"

namespace sprung {

/// A light source in a panorama that is small enough to be a key light.
struct Sun {
  Eigen::Vector3f direction;   // unit; above the horizon
  Eigen::Vector3f irradiance;  // over pi, of a surface that faces it
  float radius;                // seen from a distance of 1
};

/// Removes the sun from a panorama and fills the gap with the light of the sky around it. None, and the panorama
/// unchanged, if the brightest spot above the horizon gives level ground less than three tenths of what all the rest
/// gives.
[[nodiscard]] std::optional<Sun> extract_sun(Panorama& panorama);

/// The lighting with a sun as its key light.
[[nodiscard]] Lighting lit_by(const Sun& sun, Lighting lighting);

}  // namespace sprung
