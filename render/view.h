#pragma once
#include "render/light_maps.h"

namespace sprung {

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
