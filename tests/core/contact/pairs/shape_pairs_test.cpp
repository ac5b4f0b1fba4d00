#include "core/contact/pairs/shape_pairs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <set>

#include "tests/support/touching.h"
#include "tests/support/waves.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;
using test::Waves;

/// On random trajectories of a body and an obstacle: every point that a step may bring into it is awake,
/// even if others carry a load beside it.
long missed_points(Obstacle obstacle, unsigned seed, long& near) {
  constexpr double kStep = 1e-3;
  constexpr int kAhead = 4;
  std::mt19937 random(seed);
  SoftBody body = touching_box({4, 3, 2}, 0.02, test_material(0.3), Vec3(-0.04, 0.01, -0.02));
  SurfaceTree tree(contact_surface_of(body), body);
  ShapePairs pairs(tree, 0);
  const Waves waves(random, 0.05);
  long missed = 0;
  for (int look = 0; look < 200; ++look) {
    waves.set_velocities(body, kStep * kAhead * look);
    body.velocities.col(1).array() -= 0.5 * body.positions.col(1).mean();  // stays near
    tree.refresh();
    tree.follow(kAhead * kStep, 0);
    pairs.wake(obstacle, pose_after(obstacle, 0), kAhead * kStep);
    for (int step = 0; step < kAhead; ++step) {
      tree.refresh();
      const Pose pose = pose_after(obstacle, 0);
      std::vector<AwakePair> awake;
      pairs.measure(obstacle, pose, awake);
      std::set<int> points;
      for (const AwakePair& pair : awake) {
        points.insert(pair.pair.corners[0]);
        const bool is_loaded = pair.gap < 0.5e-3 && random() % 4 == 0;
        *pair.impulse = is_loaded ? Vec3(0, 1, 0) : Vec3(Vec3::Zero());
      }
      for (int point = 0; point < isize(tree.skin().points); ++point) {
        const Vec3 position = carried(body, tree.skin().points[point], body.positions);
        const Vec3 velocity = carried(body, tree.skin().points[point], body.velocities);
        const Gap gap = signed_distance(obstacle.shape, pose, position);
        const double closing = gap.normal.dot(velocity_at(obstacle, pose, position) - velocity);
        if (gap.distance > 0.01 || closing * kStep <= kFreeShare * (gap.distance - kMinGap * 0.02)) continue;
        ++near;
        if (!points.contains(point)) ++missed;
      }
      body.positions += kStep * body.velocities;
      obstacle.pose = pose_after(obstacle, kStep);
    }
  }
  return missed;
}

TEST(ShapePairs, NoneThatMayMeetSleeps) {
  Obstacle ground = level_ground(0);
  Obstacle rising = level_ground(0);
  rising.velocity = Vec3(0.3, 0.05, 0);
  Obstacle ball;
  ball.shape = SolidBall{0.1};
  ball.pose.translation = Vec3(0.01, -0.1, 0);
  Obstacle turning;
  turning.shape = SolidCapsule{0.03, 0.1};
  turning.pose.translation = Vec3(0, -0.03, 0.05);
  turning.spin = Vec3(1, 0.5, -2);
  for (const Obstacle& obstacle : {ground, rising, ball, turning}) {
    long near = 0;
    long missed = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) missed += missed_points(obstacle, seed, near);
    EXPECT_EQ(missed, 0);
    EXPECT_GT(near, 20) << "the test tests nothing";
  }
}

}  // namespace
}  // namespace sprung
