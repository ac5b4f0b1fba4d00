#pragma once
#include <Eigen/Core>

namespace sprung {

/// A layer that scatters light: P. Kubelka, "New Contributions to the Optics of Intensely Light-Scattering Materials"
/// (1948), between surfaces that reflect a part of the light that meets them from inside.
struct Layer {
  static constexpr float kScattering = 0.5F;  // coefficient over one mean free path; fitted to traced pictures
  static constexpr float kInner = 0.5F;       // Fresnel's reflectance for even light inside, at an index of 1.4

  Eigen::Vector3f reflected;    // fractions of the light that falls on it
  Eigen::Vector3f let_through;  // of the light on its other side

  /// `base`: what it reflects if infinitely thick. `thickness`: times the coefficient of scattering. The same as
  /// layer() of shaders/skin_light.glsl.
  Layer(const Eigen::Vector3f& base, float thickness);
};

}  // namespace sprung
