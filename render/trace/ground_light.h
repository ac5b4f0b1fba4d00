#pragma once
#include <Eigen/Core>
#include <vector>

namespace sprung {

/// Light on a rectangle of level ground, irradiance over pi, by rows of z. Beyond the rectangle it is as on its border.
struct GroundLight {
  double height;        // stage space
  Eigen::Vector2f low;  // corner x, z
  Eigen::Vector2f sides;
  int size;  // texels along each side
  std::vector<Eigen::Vector3f> texels;

  /// Bilinear.
  [[nodiscard]] Eigen::Vector3f at(float x, float z) const;
};

/// The effect of bodies on level ground: light that they reflect onto it, irradiance over pi, and the fraction of the
/// light from above that they occlude; by rows of z.
struct GroundGlow {
  Eigen::Vector2f low;  // corner x, z; stage space
  Eigen::Vector2f sides;
  int size;  // texels along each side
  std::vector<Eigen::Vector4f> texels;
};

}  // namespace sprung
