#include "render/frame.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

constexpr double kGrid = 0.25;      // of a body's radius; the maps' sides are multiples of it
constexpr double kPenumbra = 0.18;  // of a body's height: how far its soft shadow exceeds the sharp one, on the floor
constexpr double kSkyShadow = 1.6;  // of a body's radius: how far around it the floor sees less of the sky

/// The extent of all shapes along three directions (rows), in stage space.
AlignedBox extent(const std::vector<SkinShape>& shapes, const StageSpace& space, const Mat3& directions) {
  AlignedBox bounds;
  const Mat3 scaled = directions.transpose() * space.scale;
  for (const SkinShape& shape : shapes) {
    bounds.extend(
        bounding_box(((shape.positions.cast<double>().rowwise() - space.center.transpose()) * scaled).eval()));
  }
  if (bounds.isEmpty()) bounds = AlignedBox(Vec3::Zero().eval());
  return bounds;
}

/// Extended by `border`, then outwards to multiples of `grid`.
AlignedBox widened(AlignedBox bounds, const Vec3& border, double grid) {
  for (int k = 0; k < 3; ++k) {
    bounds.min()[k] = grid * std::floor((bounds.min()[k] - border[k]) / grid);
    bounds.max()[k] = grid * std::ceil((bounds.max()[k] + border[k]) / grid);
  }
  return bounds;
}

LightView view(const AlignedBox& bounds, const Mat3& directions) {
  LightView light;
  light.low = bounds.min();
  light.sides = bounds.sizes().cwiseMax(Vec3::Constant(1e-6));
  light.clip_from_stage.setIdentity();
  const Vec3 stretch = 2 * light.sides.cwiseInverse();
  light.clip_from_stage.topLeftCorner<3, 3>() = stretch.asDiagonal() * directions;
  light.clip_from_stage.topRightCorner<3, 1>() = -stretch.cwiseProduct(light.low) - Vec3::Ones();
  return light;
}

Mat3 rows(const Vec3& right, const Vec3& up, const Vec3& away) {
  Mat3 matrix;
  matrix << right.transpose(), up.transpose(), away.transpose();
  return matrix;
}

}  // namespace

LightFrame fit_light(const std::vector<SkinShape>& shapes, const StageSpace& space, double body_radius,
                     double ground_height, const Vec3& to_key) {
  LightFrame frame;
  const double grid = kGrid * body_radius;
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Vec3& light = to_key;

  const Vec3 right = y.cross(light).normalized();
  const Mat3 key = rows(right, light.cross(right), -light);
  frame.key = view(widened(extent(shapes, space, key), Vec3::Constant(0.1 * body_radius), grid), key);

  const AlignedBox box = extent(shapes, space, Mat3::Identity());
  frame.bodies = box;
  const Vec3 around(0.6 * body_radius, 0.05 * body_radius, 0.6 * body_radius);
  const AlignedBox down = widened(box, around, grid);
  const Vec3& low = down.min();
  const Vec3& high = down.max();
  frame.zenith = view({Vec3(low.x(), low.z(), -high.y()), Vec3(high.x(), high.z(), -low.y())}, rows(x, z, -y));
  const double floor = std::min(ground_height, box.min().y()) - 0.01 * body_radius;
  frame.nadir = view({Vec3(low.x(), low.z(), floor), Vec3(high.x(), high.z(), high.y())}, rows(x, z, y));

  // Where rays from the light through the bodies meet the ground: p - light * (height above ground) / light_y.
  AlignedBox cast = extent(shapes, space, rows(x - y * (light.x() / light.y()), y, z - y * (light.z() / light.y())));
  const Vec3 shift = light * (ground_height / light.y());
  cast.translate(Vec3(shift.x(), 0, shift.z()));
  const double border = std::max(kSkyShadow * body_radius, kPenumbra * (box.max().y() - ground_height));
  const AlignedBox floor_box = widened(box.merged(cast), Vec3::Constant(border), grid);
  frame.ground.low = {floor_box.min().x(), floor_box.min().z()};
  frame.ground.sides = {floor_box.max().x() - floor_box.min().x(), floor_box.max().z() - floor_box.min().z()};
  return frame;
}

void DrawFrame::set_common(const GlProgram& program) const {
  program.set("stage_center", space.center.cast<float>().eval());
  program.set("stage_scale", float(space.scale));
  program.set("to_key", lighting.to_key().cast<float>().eval());
  program.set("key_irradiance", lighting.key);
  program.set("light_radius", lighting.key_radius);
  program.set("sky_on_ground", lighting.sky);
  program.set("far_off", lighting.far_off);
  program.set("ground_albedo", lighting.floor);
  program.set("body_radius", float(body_radius));
  program.set("motion", float(motion));
  program.set("ground_height", float(ground_height));
  program.set("ground_rectangle", rectangle(light.ground.low, light.ground.sides));
  program.set("light_from_stage", light.key.clip_from_stage.cast<float>().eval());
}

Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides) {
  Eigen::Vector4f values;
  values << low.cast<float>(), sides.cast<float>();
  return values;
}

Eigen::Vector4f lookup_rectangle(const LightView& view) {
  return rectangle(view.low.head<2>(), view.sides.head<2>().cwiseInverse());
}

namespace {

constexpr double kFar = 100;  // stage space; the far plane

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

/// A projection with a slope for x and one for y (downwards: pictures begin at the top) at a distance of 1.
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
  view.sight << slopes.x() * turn.row(0).head<3>().transpose(), slopes.y() * turn.row(1).head<3>().transpose(),
      -turn.row(2).head<3>().transpose();
  view.sight_slopes = slopes;
  view.focus = (eye - target).norm();
  view.lens = 0.25 * camera.aperture * frame.space.scale / (view.focus * slope);
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
  const AlignedBox& bounds = view.frame.light.bodies;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point = bounds.corner(static_cast<AlignedBox::CornerType>(corner));
    const Eigen::Vector4d clip = view.clip_from_stage * point.homogeneous();
    if (view.near > 0 && clip.w() < view.near) return {0, 0, width, height};
    low = low.min(clip.head<2>().array() / clip.w());
    high = high.max(clip.head<2>().array() / clip.w());
  }
  const auto pixel = [](double clip, int size) {
    return std::clamp(int(std::floor((0.5 + 0.5 * std::clamp(clip, -1.0, 1.0)) * size)), 0, size - 1);
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
