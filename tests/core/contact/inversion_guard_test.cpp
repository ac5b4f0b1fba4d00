#include "core/contact/inversion_guard.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/body/forces.h"
#include "core/contact/swept_contacts.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "tests/support/bodies.h"
#include "tests/support/touching.h"
#include "tests/support/worlds.h"

namespace sprung {
namespace {

using test::box_body;
using test::test_material;
using test::touching_box;
using test::world_of;

/// Bricks far too soft for their own weight are compressed, but not inverted.
TEST(Motion, CollapsingBodyKeepsNoBrickInverted) {
  for (const double poisson : {0.1, 0.3, 0.45}) {
    World world = world_of(make_body(make_box_grid({4, 4, 4}, 0.05), Model::kCalibrated, test_material(poisson, 500)),
                           {0, -9.81, 0});
    world.obstacles = {level_ground(0)};
    world.bodies[0].damping.beta = 0.01;
    AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
    for (int frame = 0; frame < 30; ++frame) {
      static_cast<void>(motion.advance_frame(
          frame * 0.04, 0.04, [](double) {}, [](const std::string&) {}));
    }
    EXPECT_EQ(inverted_bricks(world.bodies[0]), 0) << poisson;
    EXPECT_LT(smallest_volume_ratio(world.bodies[0]), 0.5) << poisson;
  }
}

/// A wall is struck by a body far too heavy and fast for it: its bricks are crushed and recover, and none of that adds
/// energy.
TEST(InversionRate, CrushedBricksGiveNoEnergy) {
  Material soft = test_material(0.3, 5e3);
  soft.density = 500;
  Material heavy = test_material(0.3, 3e5);
  heavy.density = 8000;
  World world;
  world.gravity.setZero();
  world.bodies.push_back(touching_box({3, 12, 12}, 0.01, soft, Vec3::Zero()));
  world.bodies.push_back(touching_box({5, 5, 5}, 0.01, heavy, {-0.06, 0.04, 0.03}));
  SoftBody& wall = world.bodies[0];
  for (int node = 0; node < wall.node_count(); ++node) {
    if (wall.positions(node, 1) < 0.005) wall.pinned.push_back({.node = node});
  }
  world.bodies[1].velocities.col(0).setConstant(10);
  for (SoftBody& body : world.bodies) {
    body.damping = {};
  }
  const auto energy = [&] {
    return energy_of(wall, world.gravity).sum() + energy_of(world.bodies[1], world.gravity).sum();
  };
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  double before = energy();
  for (int frame = 0; frame < 6; ++frame) {
    static_cast<void>(motion.advance_frame(
        frame * 0.005, 0.005, [](double) {}, [](const std::string& message) { ADD_FAILURE() << message; }));
    EXPECT_LT(energy(), 1.02 * before) << frame;
    before = energy();
  }
}

/// One face turned against the opposite one by more than a right angle: the corners may be in order, but the mean axes
/// span no volume.
TEST(InversionRate, BrickTurnedOverBetweenItsCornersIsFound) {
  World world = world_of(box_body({1, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  Body& body = world.bodies[0];
  const auto& nodes = body.grid.nodes[0];
  for (int corner = 0; corner < 8; ++corner) {
    const double turn = (corner & 4) != 0 ? 2.6 : 0;  // rad, of the high face about z
    const Vec3 middle(0.01, 0.01, 0);
    const Vec3 position = body.positions.row(nodes[corner]);
    const Vec3 flipped = middle + Eigen::AngleAxisd(turn, Vec3::UnitZ()) * (position - middle);
    body.positions.row(nodes[corner]) = flipped.transpose();
  }
  InversionGuard watch;
  const std::vector<InversionRate>& found = watch.find(body, 1e-5);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const InversionRate& one) { return one.corner == InversionRate::kMeanAxes; }));

  const Vec3 momentum = linear_momentum(body);
  SweptContacts contacts({&world.bodies[0]}, world, {});
  contacts.apply(world, {body.masses.cwiseInverse()}, 0, 1e-5);
  EXPECT_LT((linear_momentum(body) - momentum).norm(), 1e-12);
  EXPECT_LT(angular_momentum(body).norm(), 1e-12);
  const double before = smallest_volume_ratio(body);
  body.positions += 1e-5 * body.velocities;
  EXPECT_GT(smallest_volume_ratio(body), before);
}

/// A brick flattened to a fifth is at that, and loses what its velocity takes from it; one that rises loses nothing.
TEST(FlattestVolume, IsThatNowAndAfterTheStep) {
  constexpr double kStep = 1e-3;  // s
  World world = world_of(box_body({1, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  Body& body = world.bodies[0];
  EXPECT_EQ(InversionGuard().flattest().now, 1);
  body.positions.col(2) *= 0.2;
  for (const double rate : {-20.0, 20.0}) {  // 1/s, of the height
    body.velocities.col(2) = rate * body.positions.col(2);
    InversionGuard guard;
    static_cast<void>(guard.find(body, kStep));
    EXPECT_NEAR(guard.flattest().now, 0.2, 1e-12);
    EXPECT_NEAR(guard.flattest().next, rate < 0 ? 0.2 * (1 + rate * kStep) : 0.2, 1e-12);
  }
}

}  // namespace
}  // namespace sprung
