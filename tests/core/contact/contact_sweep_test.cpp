#include "core/contact/contact_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/body/forces.h"
#include "core/contact/glue.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

constexpr double kBrick = 0.02;  // m

/// Moves a guarded world; after each frame of 10 ms calls see().
template <class See>
void swept_run(World& world, double duration, const See& see, Scheme scheme = Scheme::kSymplecticEuler) {
  AdaptiveIntegrator motion(world, scheme);
  for (int frame = 0; frame < std::lround(duration / 0.01); ++frame) {
    static_cast<void>(motion.advance_frame(
        0.01 * frame, 0.01, [](double) {}, [](const std::string& what) { ADD_FAILURE() << what; }));
    see();
  }
}

/// A block of 4 x 2 x 4 bricks that touches the ground.
World block_on_ground(double friction, const Vec3& gravity) {
  World world;
  world.gravity = gravity;
  world.obstacles.push_back(level_ground(0, friction));
  world.bodies.push_back(touching_box({4, 2, 4}, kBrick, test_material(0.3, 2e5), Vec3(0, kGuardedGap * kBrick, 0)));
  world.bodies[0].damping = {.alpha = 20, .beta = 1e-4};
  return world;
}

Vec3 middle_of(const SoftBody& body) { return body.positions.colwise().mean(); }

double energy(const World& world) {
  double sum = 0;
  for (const Energy& one : energies_of(world)) sum += one.sum();
  return sum;
}

TEST(ContactSweep, RestsAtTheDistanceThatItLeaves) {
  World world = block_on_ground(0.5, {0, -9.81, 0});
  swept_run(world, 0.5, [] {});
  EXPECT_LT(world.bodies[0].velocities.rowwise().norm().maxCoeff(), 1e-4);
  const double lowest = world.bodies[0].positions.col(1).minCoeff() / kBrick;
  EXPECT_GT(lowest, 0.5 * kGuardedGap);
  EXPECT_LT(lowest, 1.1 * kGuardedGap);
}

/// Ground that leans by a fiftieth less or more than friction can hold: a block that may not slide comes to rest, and
/// creeps by less than a two-thousandth of its size a second.
TEST(ContactSweep, FrictionHoldsUpToItsAngle) {
  for (const double share : {0.98, 1.02}) {
    const double angle = std::atan(0.5 * share);
    World world = block_on_ground(0.5, 9.81 * Vec3(std::sin(angle), -std::cos(angle), 0));
    world.bodies[0].damping = {.alpha = 0, .beta = 2e-3};
    swept_run(world, 1, [] {});
    const double before = middle_of(world.bodies[0]).x();
    const double speed = world.bodies[0].velocities.col(0).mean();
    swept_run(world, 0.5, [] {});
    const double way = middle_of(world.bodies[0]).x() - before;
    const double free = 9.81 * (std::sin(angle) - 0.5 * std::cos(angle));
    if (share < 1) {
      EXPECT_LT(std::abs(way), 0.5 * 5e-4 * 0.08);
    } else {
      EXPECT_NEAR(way, speed * 0.5 + free * 0.5 * 0.5 / 2, 0.05 * way);
    }
  }
}

class CollisionOfBlocks : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Friction, CollisionOfBlocks, testing::Values(0.0, 0.5));

/// Without damping and gravity, two blocks meet off centre: their total momenta are conserved, and energy only
/// decreases. Friction acts at one point of space, not across the gap.
TEST_P(CollisionOfBlocks, KeepsMomentaAndGivesNoEnergy) {
  World world;
  world.gravity.setZero();
  for (int i = 0; i < 2; ++i) {
    world.bodies.push_back(
        touching_box({3, 3, 3}, kBrick, test_material(0.3, 1e6), Vec3(0.07 * i, 0.03 * i, 0.01 * i)));
    world.bodies[i].velocities.col(0).setConstant(i == 0 ? 0.5 : -0.5);
    world.bodies[i].damping = {};
    world.bodies[i].contact.friction = GetParam();
    world.bodies[i].velocities.col(2).setConstant(i == 0 ? 0.2 : -0.2);
  }
  const auto momentum = [&] { return Vec3(linear_momentum(world.bodies[0]) + linear_momentum(world.bodies[1])); };
  const auto turning = [&] { return Vec3(angular_momentum(world.bodies[0]) + angular_momentum(world.bodies[1])); };
  const Vec3 turning_before = turning();
  const double mass = world.bodies[0].masses.sum();
  const double start = energy(world);
  double largest = 0;
  swept_run(world, 0.2, [&] { largest = std::max(largest, energy(world)); });
  EXPECT_LT(momentum().norm(), 1e-12 * mass);
  EXPECT_LT((turning() - turning_before).norm(), 1e-9 * turning_before.norm());
  EXPECT_LT(largest, start * (1 + 1e-3));
  EXPECT_GT(world.bodies[1].velocities.col(0).mean(), 0.1);
}

/// Blocks that start slightly overlapping separate slowly, and stay separated from then on.
TEST(ContactSweep, LetsOutWhatStartsInside) {
  World world = block_on_ground(0.5, {0, -9.81, 0});
  world.bodies.push_back(touching_box({4, 2, 4}, kBrick, test_material(0.3, 2e5), Vec3(0.004, 1.97 * kBrick, 0.003)));
  world.bodies[1].damping = {.alpha = 20, .beta = 1e-4};
  double fastest = 0;
  swept_run(world, 0.6, [&] {
    for (const SoftBody& body : world.bodies) {
      fastest = std::max(fastest, body.velocities.rowwise().norm().maxCoeff());
    }
  });
  EXPECT_LT(fastest, 0.1);
  const double gap = world.bodies[1].positions.col(1).minCoeff() - world.bodies[0].positions.col(1).maxCoeff();
  EXPECT_GT(gap, -0.01 * kBrick);
  EXPECT_LT(gap, 0.05 * kBrick);
}

TEST(ContactSweep, KeepsGluedBodiesTogether) {
  World world;
  world.gravity = {0, -9.81, 0};
  world.bodies.push_back(touching_box({4, 4, 4}, 0.01, test_material(0.3, 2e5), Vec3::Zero()));
  world.bodies.push_back(touching_box({3, 3, 3}, 0.04 / 3, test_material(0.3, 2e5), {0, -0.0401, 0}));
  world.glue = glue_between(world, 0, 1, 0.001);
  ASSERT_FALSE(world.glue.empty());
  for (SoftBody& body : world.bodies) body.damping = {.alpha = 20, .beta = 1e-4};
  for (int node = 0; node < world.bodies[0].node_count(); ++node) {
    if (world.bodies[0].positions(node, 1) > 0.035) world.bodies[0].pinned.push_back({.node = node});
  }
  swept_run(world, 0.3, [] {});
  for (const GluedPoint& point : world.glue) {
    const auto at = [&](std::size_t side) {
      const SoftBody& body = world.bodies[point.bodies[side]];
      return carried(body, point.bricks[side], point.weights[side], body.positions);
    };
    EXPECT_LT((at(0) - at(1)).norm(), 1e-3 * 0.01);
  }
}

/// Nodes that strike the ground leave it with that share of their speed. The energy of steps is that of the motion only
/// about.
TEST(ContactSweep, RestitutionIsThatOfTheGround) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    World world;
    world.gravity.setZero();
    world.obstacles.push_back(level_ground(0, 0, restitution));
    world.bodies.push_back(
        touching_box({2, 2, 2}, kBrick, test_material(0.3, 2e5), Vec3(0, 1.1 * kGuardedGap * kBrick, 0)));
    world.bodies[0].damping = {};
    world.bodies[0].velocities.col(1).setConstant(-0.3);
    World moving = world;
    const Group group{&world.bodies[0]};
    NearFeatures near(group, world);
    ContactSweep sweep(group, {});
    near.begin_step(world, 0, 1e-3);
    sweep.apply(near, {world.bodies[0].masses.cwiseInverse()}, 0, 1e-3);
    for (int node = 0; node < world.bodies[0].node_count(); ++node) {
      const bool is_low = world.bodies[0].positions(node, 1) < 0.5 * kBrick;
      const double speed = world.bodies[0].velocities(node, 1);
      if (is_low && restitution == 0) {
        EXPECT_NEAR(speed, -0.03, 1e-9);  // half of the distance to where it is held
      } else {
        EXPECT_NEAR(speed, is_low ? 0.3 * restitution : -0.3, 1e-9) << restitution;
      }
    }
    const double before = energy(moving);
    double after = 0;  // its mean, since that of steps wavers
    swept_run(
        moving, 0.1, [&] { after += energy(moving) / 10; }, Scheme::kVerlet);
    if (restitution < 1) {
      EXPECT_LT(after, before);
    } else {
      EXPECT_NEAR(after, before, 0.3 * before);
    }
    EXPECT_GT(moving.bodies[0].velocities.col(1).mean(), 0);
  }
}

}  // namespace
}  // namespace sprung
