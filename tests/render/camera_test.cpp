#include "render/stage/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

/// Where a point is in the picture: both coordinates in [-1, 1] inside, z > 0 in front of the camera.
Vec3 project(const Camera& camera, double aspect, const Vec3& point) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(camera.up).normalized();
  const Vec3 up = right.cross(forward);
  const Vec3 d = point - camera.eye;
  const double slope = std::tan(camera.vertical_field_of_view * std::numbers::pi / 360);
  return {d.dot(right) / (d.dot(forward) * slope * aspect), d.dot(up) / (d.dot(forward) * slope), d.dot(forward)};
}

/// The largest picture coordinate of the eight corners.
double reach(const Camera& camera, double aspect, const AlignedBox& bounds) {
  double most = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 point;
    for (int k = 0; k < 3; ++k) point[k] = ((corner >> k) & 1U) != 0 ? bounds.max()[k] : bounds.min()[k];
    const Vec3 seen = project(camera, aspect, point);
    EXPECT_GT(seen.z(), 0);
    most = std::max({most, std::abs(seen.x()), std::abs(seen.y())});
  }
  return most;
}

TEST(FrameBounds, SeesEveryCornerWithAMarginAndNotFromAfar) {
  for (const Vec3& size :
       {Vec3(1, 1, 1), Vec3(5, 0.2, 0.3), Vec3(0.1, 3, 0.1), Vec3(0.2, 0.1, 8), Vec3(1e-3, 2e-3, 0)}) {
    const AlignedBox bounds{Vec3(3, 0, -7), Vec3(3, 0, -7) + size};
    for (const double aspect : {0.5, 1.0, 16.0 / 9, 3.0}) {
      for (double azimuth = -180; azimuth < 180; azimuth += 45) {
        for (const double elevation : {-60.0, 0.0, 14.0, 45.0, 90.0}) {
          const double most = reach(frame_bounds(bounds, aspect, azimuth, elevation), aspect, bounds);
          EXPECT_LT(most, 0.9) << size.transpose() << ", " << aspect << ", " << azimuth << ", " << elevation;
          EXPECT_GT(most, 0.35) << size.transpose() << ", " << aspect << ", " << azimuth << ", " << elevation;
        }
      }
    }
  }
}

TEST(FramePoints, ComesAsNearAsThePointsAllow) {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0.5, 1, 0.2;
  const Camera camera = frame_points(points, 1, 20, 10);
  double most = 0;
  for (const auto& point : points.rowwise()) {
    const Vec3 seen = project(camera, 1, point.transpose());
    most = std::max({most, std::abs(seen.x()), std::abs(seen.y())});
  }
  EXPECT_NEAR(most, 0.88, 1e-9);
}

TEST(CarriedAround, KeepsDistanceAndHeight) {
  const Vec3 center(0.3, 0.2, -1);
  const Camera camera = frame_bounds({Vec3(0, 0, -2), Vec3(1, 1, 0)}, 1.5);
  const Camera carried = carried_around(camera, center, 75);
  EXPECT_NEAR((carried.eye - center).norm(), (camera.eye - center).norm(), 1e-12);
  EXPECT_NEAR(carried.eye.y(), camera.eye.y(), 1e-12);
  EXPECT_GT((carried.eye - camera.eye).norm(), 1);
}

TEST(FrameBounds, LooksFromWhereItIsTold) {
  const AlignedBox bounds{Vec3(-1, 0, -1), Vec3(1, 2, 1)};
  const Camera front = frame_bounds(bounds, 1, 0, 0);
  EXPECT_TRUE((front.target - front.eye).normalized().isApprox(-Vec3::UnitZ(), 1e-12));
  const Camera side = frame_bounds(bounds, 1, 90, 30);
  const Vec3 direction = (side.eye - side.target).normalized();
  EXPECT_NEAR(direction.x(), std::cos(std::numbers::pi / 6), 1e-12);
  EXPECT_NEAR(direction.y(), 0.5, 1e-12);
}

TEST(FrameBounds, FollowsTheScaleExactly) {
  const AlignedBox one{Vec3(-1, 0, -2), Vec3(1, 2, 1)};
  const AlignedBox small{1e-6 * one.min(), 1e-6 * one.max()};
  EXPECT_TRUE(frame_bounds(small, 1.5).eye.isApprox(1e-6 * frame_bounds(one, 1.5).eye, 1e-12));
}

TEST(FrameBounds, ASinglePointIsStillLookedAt) {
  const AlignedBox point{Vec3(1, 2, 3), Vec3(1, 2, 3)};
  const Camera camera = frame_bounds(point, 1);
  EXPECT_TRUE(camera.eye.allFinite());
  EXPECT_GT((camera.eye - camera.target).norm(), 0);
}

TEST(BoundingBox, CoversThePoints) {
  EXPECT_TRUE(bounding_box(Points(0, 3)).isEmpty());
  Points points(2, 3);
  points << 1, 2, 3, -1, 5, 0;
  const AlignedBox bounds = bounding_box(points);
  EXPECT_EQ(bounds.min(), Vec3(-1, 2, 0));
  EXPECT_EQ(bounds.max(), Vec3(1, 5, 3));
}

}  // namespace
}  // namespace sprung
