#include "render/light_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {

namespace {

constexpr double kKeyAzimuth = -28;     // degrees about y, as a camera's
constexpr double kKeyElevation = 52;    // degrees
constexpr double kSmallestSize = 1e-9;  // m
constexpr double kGrid = 0.25;          // of a body's radius: to what the maps' sides are rounded

/// Low and high of all shapes along three directions (rows), in stage space.
Bounds extent(const std::vector<SkinShape>& shapes, const StageSpace& space, const Mat3& directions) {
  Bounds bounds;
  const Mat3 scaled = directions.transpose() * space.scale;
  for (const SkinShape& shape : shapes) {
    bounds.include(((shape.positions.cast<double>().rowwise() - space.center.transpose()) * scaled).eval());
  }
  if (bounds.empty()) bounds.low = bounds.high = Vec3::Zero();
  return bounds;
}

/// Outwards by `border`, then to multiples of `grid`.
Bounds widened(Bounds bounds, const Vec3& border, double grid) {
  for (int k = 0; k < 3; ++k) {
    bounds.low[k] = grid * std::floor((bounds.low[k] - border[k]) / grid);
    bounds.high[k] = grid * std::ceil((bounds.high[k] + border[k]) / grid);
  }
  return bounds;
}

LightView view(const Bounds& bounds, const Mat3& directions) {
  LightView light;
  light.low = bounds.low;
  light.sides = (bounds.high - bounds.low).cwiseMax(Vec3::Constant(1e-6));
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

StageSpace::StageSpace(const Bounds& bounds)
    : center(0.5 * (bounds.low + bounds.high)),
      scale(1 / std::max(0.5 * (bounds.high - bounds.low).norm(), kSmallestSize)) {
  center = center.cast<float>().cast<double>();  // the shaders subtract it in single precision
}

Vec3 to_key_light() {
  const double a = kKeyAzimuth * std::numbers::pi / 180;
  const double e = kKeyElevation * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

LightFrame fit_light(const std::vector<SkinShape>& shapes, const StageSpace& space, double body_radius,
                     double ground_height) {
  LightFrame frame;
  const double grid = kGrid * body_radius;
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Vec3 light = to_key_light();

  const Vec3 right = y.cross(light).normalized();
  const Mat3 key = rows(right, light.cross(right), -light);
  frame.key = view(widened(extent(shapes, space, key), Vec3::Constant(0.1 * body_radius), grid), key);

  const Bounds box = extent(shapes, space, Mat3::Identity());
  frame.bodies = box;
  const Vec3 around(0.6 * body_radius, 0.05 * body_radius, 0.6 * body_radius);
  Bounds down = widened(box, around, grid);
  frame.zenith = view({{down.low.x(), down.low.z(), -down.high.y()}, {down.high.x(), down.high.z(), -down.low.y()}},
                      rows(x, z, -y));
  const double floor = std::min(ground_height, box.low.y()) - 0.01 * body_radius;
  frame.nadir =
      view({{down.low.x(), down.low.z(), floor}, {down.high.x(), down.high.z(), down.high.y()}}, rows(x, z, y));

  // Where rays from the light through the bodies meet the ground: p - light * (height above ground) / light_y.
  Bounds cast = extent(shapes, space, rows(x - y * (light.x() / light.y()), y, z - y * (light.z() / light.y())));
  const Vec3 shift = light * (ground_height / light.y());
  cast.low += Vec3(shift.x(), 0, shift.z());
  cast.high += Vec3(shift.x(), 0, shift.z());
  Bounds floor_box;
  floor_box.low = box.low.cwiseMin(cast.low);
  floor_box.high = box.high.cwiseMax(cast.high);
  floor_box = widened(floor_box, Vec3::Constant(1.6 * body_radius), grid);
  frame.ground.low = {floor_box.low.x(), floor_box.low.z()};
  frame.ground.sides = {floor_box.high.x() - floor_box.low.x(), floor_box.high.z() - floor_box.low.z()};
  return frame;
}

}  // namespace sprung
