#pragma once
#include "render/gl/objects.h"
#include "render/light_frame.h"

namespace sprung {

/// What the shaders share within one frame.
struct DrawFrame {
  StageSpace space;
  LightFrame light;
  double body_radius;    // of the largest body, stage space
  double ground_height;  // stage space
  bool has_ground;
  Eigen::Vector3f sky_on_ground;  // irradiance / pi of the open sky on level ground

  /// Sets the uniforms that every program with a skin or a light map knows.
  void set_common(const GlProgram& program) const;
};

/// x, z of the low corner and the sides, as the shaders take a rectangle of the ground.
[[nodiscard]] Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides);

/// Low corner and one over the sides, in x and z, of a view that looks up or down.
[[nodiscard]] Eigen::Vector4f lookup_rectangle(const LightView& view);

}  // namespace sprung
