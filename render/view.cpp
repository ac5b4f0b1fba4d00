#include "render/view.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {

namespace {

constexpr double kFar = 100;  // stage space, where 1 is the radius of everything; the end of what is drawn

Eigen::Matrix4d view_from_stage(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 backwards = (eye - target).normalized();
  const Vec3 right = up.cross(backwards).normalized();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.row(0).head<3>() = right;
  view.row(1).head<3>() = backwards.cross(right);
  view.row(2).head<3>() = backwards;
  view.topRightCorner<3, 1>() = -view.topLeftCorner<3, 3>() * eye;
  return view;
}

/// With a slope for x and one for y (downwards: pictures begin at the top) at a distance of 1.
Eigen::Matrix4d perspective(const Eigen::Vector2d& slopes, double shift, double near, double far) {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 1 / slopes.x();
  clip(0, 2) = -shift;
  clip(1, 1) = 1 / slopes.y();
  clip(2, 2) = -(far + near) / (far - near);
  clip(2, 3) = -2 * far * near / (far - near);
  clip(3, 2) = -1;
  return clip;
}

Eigen::Matrix4d parallel(const Eigen::Vector2d& halves, double shift, double near, double far) {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip(0, 0) = 1 / halves.x();
  clip(0, 3) = shift;
  clip(1, 1) = 1 / halves.y();
  clip(2, 2) = -2 / (far - near);
  clip(2, 3) = -(far + near) / (far - near);
  return clip;
}

}  // namespace

View make_view(const DrawFrame& frame, const Camera& camera, double aspect) {
  const Vec3 eye = frame.space.from_world(camera.eye);
  const Vec3 target = frame.space.from_world(camera.target);
  const double away = eye.norm();
  const Eigen::Matrix4d turn = view_from_stage(eye, target, camera.up);
  const double slope = std::tan(camera.vertical_field_of_view * std::numbers::pi / 360);
  const Eigen::Vector2d slopes(slope * aspect, -slope);
  View view{.frame = frame, .eye = eye};
  view.sight_height = Vec3(slopes.x() * turn(0, 1), slopes.y() * turn(1, 1), -turn(2, 1));
  view.sight_slopes = slopes;
  const double far = away + kFar;
  if (camera.orthographic) {
    const double near = away - kFar;
    view.clip_from_stage = parallel(slopes * (eye - target).norm(), camera.shift, near, far) * turn;
    view.distance_terms = {far - near, near, 0, 1};
    view.eye = eye + kFar * kFar * (eye - target).normalized();
  } else {
    view.near = std::max(0.02 * away, 0.002);
    view.clip_from_stage = perspective(slopes, camera.shift, view.near, far) * turn;
    view.distance_terms = {0, 1, 1 / far - 1 / view.near, 1 / view.near};
  }
  return view;
}

PixelRectangle seen_rectangle(const View& view, int width, int height) {
  Eigen::Array2d low(1, 1);
  Eigen::Array2d high(-1, -1);
  const Bounds& bounds = view.frame.light.bodies;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place((corner & 1) != 0 ? bounds.high.x() : bounds.low.x(),
                     (corner & 2) != 0 ? bounds.high.y() : bounds.low.y(),
                     (corner & 4) != 0 ? bounds.high.z() : bounds.low.z());
    const Eigen::Vector4d clip = view.clip_from_stage * place.homogeneous();
    if (view.near > 0 && clip.w() < view.near) return {0, 0, width, height};
    low = low.min(clip.head<2>().array() / clip.w());
    high = high.max(clip.head<2>().array() / clip.w());
  }
  const auto pixel = [](double clip, int size) {
    return std::clamp(static_cast<int>(std::floor((0.5 + 0.5 * std::clamp(clip, -1.0, 1.0)) * size)), 0, size - 1);
  };
  PixelRectangle seen{pixel(low.x(), width), pixel(low.y(), height), 0, 0};
  seen.width = std::max(0, pixel(high.x(), width) - seen.left + 1);
  seen.height = std::max(0, pixel(high.y(), height) - seen.top + 1);
  return seen;
}

Vec3 floor_depth(const View& view) {
  const Eigen::Matrix4d stage = view.clip_from_stage.inverse();
  const Eigen::RowVector4d p = stage.row(1) - view.frame.ground_height * stage.row(3);
  return {-p[0] / p[2], -p[1] / p[2], 0.5 - 0.5 * (p[3] - p[0] - p[1]) / p[2]};
}

}  // namespace sprung
