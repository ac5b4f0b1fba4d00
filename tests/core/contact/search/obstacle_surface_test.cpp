#include "core/contact/search/obstacle_surface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/contact/search/contact_surface.h"

namespace sprung {
namespace {

/// All points lie on the box, and every area vector points outward: the volume is that of the box.
TEST(ObstacleSurface, IsThatOfTheBoxWhereverItIs) {
  Obstacle box;
  box.shape = SolidBox{Vec3(0.3, 0.1, 0.05)};
  box.pose.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  box.pose.translation = Vec3(1, 2, 3);
  box.velocity = Vec3(1, 0, 0);
  box.spin = Vec3(0, 2, 0);
  SoftBody surface = obstacle_surface(box, 0.02);
  move_surface(box, 0.1, 0.01, surface);
  const ContactSurface& skin = contact_surface_of(surface);
  const Pose pose = pose_after(box, 0.1);
  const Pose next = pose_after(box, 0.11);
  std::vector<Vec3> positions;
  double furthest = 0;
  for (const ContactPoint& point : skin.points) {
    positions.push_back(carried(surface, point, surface.positions));
    furthest = std::max(furthest, std::abs(signed_distance(box.shape, pose, positions.back()).distance));
    const Vec3 moved = positions.back() + 0.01 * carried(surface, point, surface.velocities);
    furthest = std::max(furthest, std::abs(signed_distance(box.shape, next, moved).distance));
  }
  EXPECT_LT(furthest, 1e-12);
  double volume = 0;
  for (const auto& [a, b, c] : skin.triangles) {
    volume += (positions[a] - pose.translation)
                  .dot((positions[b] - pose.translation).cross(positions[c] - pose.translation)) /
              6;
    EXPECT_LT((positions[a] - positions[b]).norm(), 0.09);
  }
  EXPECT_NEAR(volume, 8 * 0.3 * 0.1 * 0.05, 1e-12);
}

TEST(ObstacleSurface, OfACylinderIsAPrismWithinIt) {
  Obstacle cylinder;
  cylinder.shape = SolidCylinder{0.1, 0.05};
  SoftBody surface = obstacle_surface(cylinder, 0.02);
  const ContactSurface& skin = contact_surface_of(surface);
  double volume = 0;
  const auto place = [&](int point) { return carried(surface, skin.points[point], surface.positions); };
  for (const auto& [a, b, c] : skin.triangles) volume += place(a).dot(place(b).cross(place(c))) / 6;
  EXPECT_NEAR(volume, std::numbers::pi * 0.1 * 0.1 * 0.1, 0.002 * std::numbers::pi * 0.1 * 0.1 * 0.1);
  for (int point = 0; point < isize(skin.points); ++point) {
    const double distance = signed_distance(cylinder.shape, {}, place(point)).distance;
    EXPECT_LT(distance, 1e-9);
    EXPECT_GT(distance, -2e-4);
  }
}

TEST(ObstacleSurface, OthersHaveNone) {
  Obstacle ball;
  ball.shape = SolidBall{0.1};
  EXPECT_FALSE(has_edges(ball.shape));
  EXPECT_FALSE(has_edges(level_ground(0).shape));
  EXPECT_TRUE(has_edges(SolidBox{}));
}

}  // namespace
}  // namespace sprung
