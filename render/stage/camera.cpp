#include "render/stage/camera.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sprung {

namespace {

constexpr double kMargin = 0.12;            // of half the picture, kept free at each side
constexpr double kFloorMargin = 0.06;       // of the sides: floor seen around the lowest points, where the shadow falls
constexpr double kSmallestDistance = 1e-9;  // m; keeps the camera away from a single point

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Columns: right, up and backwards (towards the viewer).
Mat3 camera_axes(double azimuth, double elevation) {
  const double a = radians(azimuth);
  const double e = radians(std::clamp(elevation, -89.0, 89.0));
  const Vec3 backwards(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
  Mat3 axes;
  axes.col(0) = Vec3(std::cos(a), 0, -std::sin(a));
  axes.col(1) = backwards.cross(axes.col(0));
  axes.col(2) = backwards;
  return axes;
}

/// The corners of the bounds and, slightly further out, those of the floor below.
Points points_to_see(const AlignedBox& bounds) {
  Points points(12, 3);
  for (int c = 0; c < 8; ++c) {
    for (int k = 0; k < 3; ++k) points(c, k) = ((c >> k) & 1) != 0 ? bounds.max()[k] : bounds.min()[k];
  }
  const Vec3 sides = bounds.sizes();
  const double x = kFloorMargin * std::max(sides.x(), sides.y());
  const double z = kFloorMargin * std::max(sides.z(), sides.y());
  for (int c = 0; c < 4; ++c) {
    points.row(8 + c) << ((c & 1) != 0 ? bounds.max().x() + x : bounds.min().x() - x), bounds.min().y(),
        ((c & 2) != 0 ? bounds.max().z() + z : bounds.min().z() - z);
  }
  return points;
}

/// Along one axis of the picture: the extreme points, projected to the viewer's depth along the edges of the view.
struct Extent {
  double low = 1e300;
  double high = -1e300;
};

}  // namespace

Camera frame_points(const Points& points, double aspect, double azimuth, double elevation, bool orthographic) {
  assert(points.rows() > 0 && aspect > 0);
  Camera camera;
  const Vec3 center = 0.5 * (points.colwise().minCoeff() + points.colwise().maxCoeff());
  const Mat3 axes = camera_axes(azimuth, elevation);
  const double slope_y = std::tan(radians(camera.vertical_field_of_view / 2)) * (1 - kMargin);
  const Eigen::Vector2d slope(slope_y * aspect, slope_y);
  const double nearer = orthographic ? 0 : 1;  // perspective enlarges what is near
  camera.orthographic = orthographic;

  // A point q is in view where |q_k - eye_k| <= slope_k (eye_z - q_z): per axis two lines that the eye has to satisfy.
  std::array<Extent, 2> extent;
  for (const auto& point : points.rowwise()) {
    const Vec3 q = axes.transpose() * (point.transpose() - center);
    for (int k = 0; k < 2; ++k) {
      Extent& e = extent[k];
      e.high = std::max(e.high, q[k] + nearer * slope[k] * q.z());
      e.low = std::min(e.low, q[k] - nearer * slope[k] * q.z());
    }
  }
  Vec3 eye;
  for (int k = 0; k < 2; ++k) {
    eye[k] = 0.5 * (extent[k].high + extent[k].low);
  }
  eye.z() =
      std::max((extent[0].high - extent[0].low) / (2 * slope.x()), (extent[1].high - extent[1].low) / (2 * slope.y()));

  eye.z() = std::max(eye.z(), kSmallestDistance);

  camera.eye = center + axes * eye;
  camera.target = center + axes * Vec3(eye.x(), eye.y(), 0);
  return camera;
}

Camera frame_bounds(const AlignedBox& bounds, double aspect, double azimuth, double elevation) {
  assert(!bounds.isEmpty());
  return frame_points(points_to_see(bounds), aspect, azimuth, elevation);
}

Camera carried_around(const Camera& camera, const Vec3& center, double degrees) {
  const Eigen::AngleAxisd turn(radians(degrees), Vec3::UnitY());
  Camera carried = camera;
  carried.eye = center + turn * (camera.eye - center);
  carried.target = center + turn * (camera.target - center);
  carried.up = turn * camera.up;
  return carried;
}

}  // namespace sprung
