#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/body/forces.h"
#include "core/contact/pairs/awake_pair.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "tests/support/calibrated_box.h"
#include "tests/support/sanitized.h"
#include "tests/support/worlds.h"

/// Contact of bodies with obstacles in implicit steps.
namespace sprung {
namespace {

using test::calibrated_box;
using test::world_of;

constexpr double kGravity = 9.81;

TEST(ImplicitContact, DroppedCubeBouncesAndComesToRestOnTheGround) {
  const double size = 0.1;
  const int bricks = test::kSanitized ? 3 : 6;
  for (const ImplicitScheme scheme : {ImplicitScheme::kEuler, ImplicitScheme::kBdf2}) {
    Body cube = calibrated_box({bricks, bricks, bricks}, size / bricks, 0.3, 2e4);
    cube.damping.beta = 1e-2;
    const Mat3 tilted = Eigen::AngleAxisd(0.4, Vec3(1, 0.5, 0.2).normalized()).toRotationMatrix();
    place(cube, tilted, Vec3(0, 0.12, 0));
    World world = world_of(std::move(cube), {0, -kGravity, 0});
    world.obstacles = {level_ground(0, 0.5, 0)};
    const Body& body = world.bodies[0];
    ImplicitMotion motion(world, {.scheme = scheme});
    double deepest = 0;
    double fastest_up = 0;
    double fastest_down = 0;
    for (int step = 0; step < 440; ++step) {
      motion.advance(0.005, 1, 0);
      deepest = std::max(deepest, -body.positions.col(1).minCoeff());
      const double speed = linear_momentum(body).y() / body.masses.sum();
      fastest_up = std::max(fastest_up, speed);
      fastest_down = std::max(fastest_down, -speed);
    }
    EXPECT_LT(deepest, 0.02 * size);
    EXPECT_GT(fastest_up, 0.05);
    EXPECT_EQ(inverted_bricks(body), 0);
    EXPECT_LT(body.velocities.rowwise().norm().maxCoeff(), 0.01 * fastest_down) << int(scheme);
    EXPECT_LT(-body.positions.col(1).minCoeff(), 0.005 * size);  // at rest
  }
}

/// Gravity tilted by 0.3 rad is a slope. A stiff block slides down with g (sin - mu cos) or stays; what stays creeps by
/// less than 0.5 % of its length a second.
TEST(ImplicitContact, FrictionSticksBelowItsAngleAndSlidesAboveIt) {
  const double tilt = 0.3;
  for (const double friction : {0.2, 0.5}) {
    Body block = calibrated_box({6, 3, 6}, 0.02, 0.3, 3e5);
    block.damping.beta = 1e-3;
    World world = world_of(std::move(block), {kGravity * std::sin(tilt), -kGravity * std::cos(tilt), 0});
    world.obstacles = {level_ground(0, friction, 0)};
    const Body& body = world.bodies[0];
    const auto centre = [&] { return (body.positions.transpose() * body.masses).x() / body.masses.sum(); };
    ImplicitMotion motion(world, {});
    motion.advance(0.005, 40, 0);
    const double x0 = centre();
    const double v0 = linear_momentum(body).x() / body.masses.sum();
    motion.advance(0.005, 100, 0);
    const double t = 0.5;
    const double a = kGravity * (std::sin(tilt) - friction * std::cos(tilt));
    const bool slides = friction < std::tan(tilt);
    const double expected = slides ? v0 * t + a * t * t / 2 : 0;
    EXPECT_NEAR(centre() - x0, expected, slides ? 0.03 * expected : 2.5e-3 * 0.12) << friction;
  }
}

/// A plate presses a cube to four fifths of its height: the nodes end where explicit steps leave them.
TEST(ImplicitContact, PlatesPressAsInExplicitSteps) {
  const auto make = [](double gap) {  // m, that contact leaves
    Body cube = calibrated_box({4, 4, 4}, 0.02, 0.3, 2e4);
    cube.damping.beta = 5e-3;
    World world = world_of(std::move(cube), {0, 0, 0});
    Obstacle plate{.shape = SolidBox{.half = {0.1, 0.01, 0.1}}, .pose = {.translation = {0, 0.09 + gap, 0}}};
    plate.velocity.y() = -0.04;
    plate.friction = 0.4;
    world.obstacles = {level_ground(-gap, 0.4, 0), plate};
    return world;
  };
  World explicit_world = make(kGuardedGap * 0.02);
  World implicit_world = make(0);
  test::advance_by_stable_steps(explicit_world, Scheme::kSymplecticEuler, 0.4);
  ImplicitMotion(implicit_world, {}).advance(0.01, 40, 0);
  EXPECT_NEAR(implicit_world.obstacles[1].pose.translation.y(), 0.074, 1e-12);
  const Body& body = implicit_world.bodies[0];
  const double pressed = (body.positions - body.rest_positions).norm();
  EXPECT_NEAR(body.positions.col(1).maxCoeff(), 0.064, 1e-3);
  EXPECT_LT((explicit_world.bodies[0].positions - body.positions).norm(), 0.05 * pressed);
}

/// A belt carries a block along: friction accelerates it up to the belt's speed, by at most mu g.
TEST(ImplicitContact, AMovingBeltTakesABlockAlong) {
  Body block = calibrated_box({4, 2, 4}, 0.02, 0.3, 2e5);
  block.damping.beta = 1e-3;
  World world = world_of(std::move(block), {0, -kGravity, 0});
  Obstacle belt = level_ground(0, 0.3);
  belt.velocity.x() = 0.3;
  world.obstacles = {belt};
  const Body& body = world.bodies[0];
  const auto speed = [&] { return linear_momentum(body).x() / body.masses.sum(); };
  ImplicitMotion motion(world, {});
  motion.advance(0.005, 10, 0);
  EXPECT_NEAR(speed(), 0.3 * kGravity * 0.05, 0.03);
  motion.advance(0.005, 60, 0);
  EXPECT_NEAR(speed(), 0.3, 0.01);
}

}  // namespace
}  // namespace sprung
