#pragma once
#include <vector>

#include "core/types.h"
#include "render/gl/objects.h"
#include "render/renderer.h"

namespace sprung {

/// The renderer's own coordinates: the middle of the stage's bounds is the origin, their half diagonal is 1. Every
/// bias and every width in the shaders is a number in these, so a picture does not depend on the size in metres.
struct StageSpace {
  Vec3 center = Vec3::Zero();  // m
  double scale = 1;            // 1/m

  explicit StageSpace(const AlignedBox& bounds);
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
  AlignedBox bodies;       // stage space
  LightView key;           // along the key light
  LightView zenith;        // downwards
  LightView nadir;         // upwards, from the ground
  GroundRectangle ground;  // holds the bodies, their shadow and a border
};

/// `body_radius`: of the largest body, in stage space.
[[nodiscard]] LightFrame fit_light(const std::vector<SkinShape>& shapes, const StageSpace& space, double body_radius,
                                   double ground_height);

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

/// One frame as a camera sees it, in stage space. Clip coordinates run downwards: pictures begin at the top.
struct View {
  DrawFrame frame;
  Vec3 eye;
  double near = 0;  // in front of the eye; 0: parallel lines of sight
  Eigen::Matrix4d clip_from_stage = Eigen::Matrix4d::Identity();
  /// (x d + y) / (z d + w) is the distance along the camera's axis at depth d, 0 to 1.
  Eigen::Vector4d distance_terms = Eigen::Vector4d::Zero();
  /// Of (x, y, 1) in clip space: how much the line of sight rises, and how much it leans sideways, for a step of 1
  /// ahead.
  Vec3 sight_height = Vec3::Zero();
  Eigen::Vector2d sight_slopes = Eigen::Vector2d::Zero();
};

/// `aspect`: width / height.
[[nodiscard]] View make_view(const DrawFrame& frame, const Camera& camera, double aspect);

struct PixelRectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// The part of a picture of that size that holds all bodies.
[[nodiscard]] PixelRectangle seen_rectangle(const View& view, int width, int height);

/// The depth of the floor at (x, y) of the picture, both 0 to 1: it is a plane there too, a x + b y + c.
[[nodiscard]] Vec3 floor_depth(const View& view);

}  // namespace sprung
