#pragma once
#include <vector>

#include "core/types.h"
#include "render/gl/objects.h"
#include "render/stage/stage.h"
#include "render/stage/stage_space.h"

namespace sprung {

/// An axis-aligned rectangle of the ground, in stage space.
struct GroundRectangle {
  Eigen::Vector2d low;    // x, z
  Eigen::Vector2d sides;  // x, z
};

/// A parallel projection of all bodies.
struct LightView {
  Eigen::Matrix4d clip_from_stage;
  Vec3 low;    // along the view's axes: right, up, away
  Vec3 sides;  // > 0
};

/// The extents of the light maps in one frame. They are rounded up to a grid, so that texels stay in place from frame
/// to frame while a body moves a little, and shadows do not flicker.
struct LightFrame {
  AlignedBox bodies;       // stage space
  LightView key;           // along the key light
  LightView zenith;        // downwards
  LightView nadir;         // upwards, from the ground
  GroundRectangle ground;  // covers the bodies, their shadow and a border
};

/// `body_radius`: of the largest body, in stage space.
[[nodiscard]] LightFrame fit_light(const std::vector<SkinShape>& shapes, const StageSpace& space, double body_radius,
                                   double ground_height, const Vec3& to_key);

/// The values that the shaders share within one frame.
struct DrawFrame {
  StageSpace space;
  LightFrame light;
  double body_radius;    // of the largest body, stage space
  double ground_height;  // stage space
  bool has_ground;
  Lighting lighting;
  double motion = 0;  // largest, of any point from its position in the light maps; stage space

  /// Sets the uniforms of every program that draws a skin or a light map.
  void set_common(const GlProgram& program) const;
};

/// A rectangle of the ground as the shaders take it: x, z of the low corner, then the sides.
[[nodiscard]] Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides);

/// x, z of the low corner, then one over the sides, of a view that looks up or down.
[[nodiscard]] Eigen::Vector4f lookup_rectangle(const LightView& view);

/// One frame as a camera sees it, in stage space. The y axis of clip space points down, since rows start at the top.
struct View {
  DrawFrame frame;
  Vec3 eye;
  double near = 0;  // distance of the near plane; 0: parallel projection
  Eigen::Matrix4d clip_from_stage = Eigen::Matrix4d::Identity();
  /// (x d + y) / (z d + w) is the distance along the camera's axis at depth d, 0 to 1.
  Eigen::Vector4d distance_terms = Eigen::Vector4d::Zero();
  /// Times (x, y, 1) in clip space: the line of sight, of length 1 along the camera's axis; and its sideways slopes.
  Mat3 sight = Mat3::Zero();
  Eigen::Vector2d sight_slopes = Eigen::Vector2d::Zero();
  double lens = 0;   // circle of confusion of a point at infinity: its radius over the height of the picture
  double focus = 0;  // distance along the camera's axis
};

/// `aspect`: width / height.
[[nodiscard]] View make_view(const DrawFrame& frame, const Camera& camera, double aspect);

struct PixelRectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// The pixels that contain all bodies, in a picture of that size.
[[nodiscard]] PixelRectangle seen_rectangle(const View& view, int width, int height);

/// Coefficients (a, b, c) of the floor's depth a x + b y + c at (x, y) of the picture, both 0 to 1.
[[nodiscard]] Vec3 floor_depth(const View& view);

}  // namespace sprung
