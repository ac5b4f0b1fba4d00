#pragma once
#include <vector>

#include "core/types.h"
#include "render/renderer.h"

namespace sprung {

/// The renderer's own coordinates: the middle of the stage's bounds is the origin, their half diagonal is 1. Every
/// bias and every width in the shaders is a number in these, so a picture does not depend on the size in metres.
struct StageSpace {
  Vec3 center = Vec3::Zero();  // m
  double scale = 1;            // 1/m

  explicit StageSpace(const Bounds& bounds);
  [[nodiscard]] Vec3 from_world(const Vec3& point) const { return (point - center) * scale; }
};

/// Unit vector towards the key light, in the world: from the left of a camera at 30 degrees, and from above.
[[nodiscard]] Vec3 to_key_light();

/// An axis-aligned rectangle of the ground, in stage space.
struct GroundRectangle {
  Eigen::Vector2d low;    // x, z
  Eigen::Vector2d sides;  // x, z
};

/// A parallel view of all bodies.
struct LightView {
  Eigen::Matrix4d clip_from_stage;
  Vec3 low;    // along the view's axes: right, up, away
  Vec3 sides;  // > 0
};

/// Where the bodies of one frame are, as the light maps need it. Sizes are rounded up to a grid, so that they and the
/// texels stay put from frame to frame while a body moves a little.
struct LightFrame {
  Bounds bodies;           // stage space
  LightView key;           // along the key light
  LightView zenith;        // downwards
  LightView nadir;         // upwards, from the ground
  GroundRectangle ground;  // holds the bodies, their shadow and a border
};

/// `body_radius`: of the largest body, in stage space.
[[nodiscard]] LightFrame fit_light(const std::vector<SkinShape>& shapes, const StageSpace& space, double body_radius,
                                   double ground_height);

}  // namespace sprung
