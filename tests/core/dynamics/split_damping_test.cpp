#include "core/dynamics/explicit/split_damping.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "core/body/forces.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "tests/support/bodies.h"
#include "tests/support/worlds.h"

namespace sprung {
namespace {

using test::test_material;
using test::world_of;

constexpr double kLength = 0.2;

World damped_bar(double damping) {
  Material material = test_material(0.3, 1e5);
  material.damping = damping;
  return world_of(make_body(make_box_grid({20, 4, 4}, kLength / 20), Model::kCalibrated, material));
}

/// Twisted about its axis as its slowest torsional vibration is.
void twist(Body& body) {
  for (int node = 0; node < body.node_count(); ++node) {
    const Vec3 position = body.positions.row(node);
    const Vec3 arm(0, position.y() - 0.02, position.z() - 0.02);
    const double spin = 5 * std::cos(std::numbers::pi * position.x() / kLength);
    body.velocities.row(node) = (spin * Vec3::UnitX().cross(arm)).transpose();
  }
}

/// A vibration dies away as in implicit steps, which have the whole damping at once; and steps are hardly shorter than
/// without damping.
TEST(SplitDamping, VibrationDiesAwayAsInImplicitMotion) {
  for (const double ratio : {0.05, 0.2}) {
    World world = damped_bar(ratio);
    World undamped = damped_bar(0);
    EXPECT_GT(stable_step(world), 0.6 * stable_step(undamped));
    World implicit = damped_bar(ratio);
    twist(world.bodies[0]);
    twist(implicit.bodies[0]);
    const double before = kinetic_energy(world.bodies[0]);
    const double time = 2 * kLength / std::sqrt(1e5 / 2.6 / 1000);  // about a period
    const double dt = stable_step(world);
    const long steps = std::lround(std::ceil(time / dt));
    World fine = world;
    advance(world, Scheme::kVerlet, time / double(steps), steps, 0);
    advance(fine, Scheme::kVerlet, time / double(3 * steps), 3 * steps, 0);
    ImplicitMotion(implicit, {.scheme = ImplicitScheme::kBdf2}).advance(time / 400, 400, 0);
    const auto left = [&](const World& one) {
      return (kinetic_energy(one.bodies[0]) + elastic_energy(one.bodies[0])) / before;
    };
    EXPECT_LT(left(implicit), 0.8);
    EXPECT_NEAR(left(world), left(implicit), 0.12 * left(implicit));
    EXPECT_NEAR(left(fine), left(implicit), 0.12 * left(implicit));
  }
}

/// A rigid motion is not damped, and momenta are conserved however early the iterations stop.
TEST(SplitDamping, FreeBodyKeepsItsMomenta) {
  World world = damped_bar(0.3);
  Body& body = world.bodies[0];
  for (int node = 0; node < body.node_count(); ++node) {
    const Vec3 arm = body.positions.row(node).transpose() - Vec3(0.1, 0.02, 0.02);
    body.velocities.row(node) = (Vec3(1, 2, 3) + Vec3(0.3, 2, -1).cross(arm)).transpose();
    body.velocities(node, 1) += 0.2 * std::sin(40 * arm.x());
  }
  const Vec3 linear = linear_momentum(body);
  const Vec3 angular = angular_momentum(body);
  advance(world, Scheme::kSymplecticEuler, stable_step(world), 2000, 0);
  EXPECT_LT((linear_momentum(body) - linear).norm(), 1e-11 * linear.norm());
  EXPECT_LT((angular_momentum(body) - angular).norm(), 1e-9 * angular.norm());
}

/// Velocities that vary from node to node lose energy, whatever the time that is due; also in a body that was
/// compressed, or drawn, after its fastest vibration was found.
TEST(SplitDamping, NeverAddsEnergy) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double stretch : {1.0, 0.8, 3.0}) {
    for (const double time : {1e-5, 1e-4, 1e-3, 1e-2, 10.0}) {
      World world = damped_bar(0.3);
      SoftBody& body = world.bodies[0];
      const double squared = largest_frequency_squared(body);
      body.positions.col(0) *= stretch;
      for (double& velocity : body.velocities.reshaped()) velocity = uniform(random);
      SplitDamping damping(body, body.damping.beta, squared);
      double before = kinetic_energy(body);
      for (int i = 0; i < 5; ++i) {
        static_cast<void>(damping.add(time));
        damping.settle();
        EXPECT_LT(kinetic_energy(body), before);
        before = kinetic_energy(body);
      }
    }
  }
}

/// Pinned nodes keep their velocity; the rest comes to follow them.
TEST(SplitDamping, HeldNodesLead) {
  World world = damped_bar(5);
  SoftBody& body = world.bodies[0];
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.positions(node, 0) > 1e-9) continue;
    body.pinned.push_back({.node = node, .velocity = {0.01, 0, 0}});
    body.velocities(node, 0) = 0.01;
  }
  SplitDamping damping(body, body.damping.beta, largest_frequency_squared(body));
  const double before = body.velocities.col(0).sum();
  EXPECT_FALSE(damping.add(1e-3));
  damping.settle();
  EXPECT_GT(body.velocities.col(0).sum(), before);
  for (const KinematicNode& pinned : body.pinned) EXPECT_EQ(body.velocities(pinned.node, 0), 0.01);
  EXPECT_LE(body.velocities.maxCoeff(), 0.0100001);
}

}  // namespace
}  // namespace sprung
