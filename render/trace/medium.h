#pragma once
#include <Eigen/Core>
#include <optional>

namespace sprung {

/// The inside of a translucent body. It scatters light isotropically and alike in all colours, and absorbs each colour
/// along the path (Beer and Lambert's law), such that a thick body reflects the body's colour: M. Chiang, P. Kutz and
/// B. Burley, "Practical and Controllable Subsurface Scattering for Production Path Tracing" (2016).
struct Medium {
  static constexpr float kIndex = 1.4F;  // of refraction: silicone has 1.41, gelatin 1.34 to 1.4

  static constexpr float kDarkest = 0.004F;  // colour: a darker one would absorb everything at once

  float scattering;            // per unit of length: one over the mean free path
  Eigen::Vector3f absorption;  // per unit of length

  /// `color`: linear, that of a thick body.
  Medium(const Eigen::Vector3f& color, float scattering);
  /// The fraction of light that is not absorbed over a distance.
  [[nodiscard]] Eigen::Vector3f kept(float way) const { return (-way * absorption).array().exp(); }
  /// The fraction that is neither absorbed nor scattered.
  [[nodiscard]] Eigen::Vector3f transmitted(float way) const { return std::exp(-way * scattering) * kept(way); }
};

/// Fresnel's reflectance of a smooth surface for unpolarised light. `cosine`: of the ray to the normal, > 0; `index`:
/// of refraction behind the surface over that in front of it.
[[nodiscard]] float fresnel(float cosine, float index);

/// Snell's law: the direction (unit) of a ray behind a surface whose unit normal points against it; none if it is
/// totally reflected.
[[nodiscard]] std::optional<Eigen::Vector3f> refracted(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal,
                                                       float index);

}  // namespace sprung
